/// \file Wachspress shape functions of a convex polygon, Eq. (6).
#pragma once

#include <polyfem/basis/basis.hpp>

#include <optional>
#include <string_view>

namespace polyfem {

/// The rational functions of a strictly convex polygon; on a triangle the linear ones.
///
/// With a_k = A(x, v_k, v_k+1) and b_i = A(v_i-1, v_i, v_i+1), A being twice a triangle's area, the weight of
/// (6) over the product of all a_k is
///     w_i = b_i / (a_i-1 a_i),   N_i = w_i / sum_j w_j,   grad N_i = N_i sum_j N_j (r_i - r_j),
/// where r_i = grad log w_i. Near edge i, r_i and r_i+1 share a large grad log a_i, which must not enter
/// their difference. So only the steps from a vertex to the next are formed, in which it has gone,
///     r_i+1 - r_i = grad log (a_i-1 / a_i+1),
/// and summed by parts from the front and the back of the polygon:
///     sum_{j < i+1} N_j (r_i+1 - r_j) = sum_{j < i} N_j (r_i - r_j) + (r_i+1 - r_i) sum_{j <= i} N_j.
/// That is O(n) for all functions, one form for all points, edges and vertices included, at any size and
/// offset. Values (absolute) and gradients (relative to the largest at the point) are within 1e-14 of exact
/// while corners turn by 1e-3 or more, and in needles down to a width of 1e-9 of their length; 1e-13 (values)
/// and 4e-13 (gradients) were seen at 1e-12. Towards straight corners digits are lost as 1 / turn: pentagons
/// had 1e-19 / turn. At a vertex the gradient is that of the linear triangle of its corner. A point has the
/// same bytes whatever the others.
class Wachspress final : public Basis {
 public:
  std::string_view name() const override { return "wachspress"; }
  /// A corner that does not turn left. Exact.
  std::optional<Rejection> find_rejection(const PointsRef& polygon) const override;
  /// Throws Error, naming the vertex and the cure, where a corner is concave or straight.
  void evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const override;
};

/// It has no state: one is enough.
inline constexpr Wachspress wachspress;

}  // namespace polyfem
