/// \file Wachspress shape functions of a convex polygon, Eq. (6).
#pragma once

#include <polyfem/basis/basis.hpp>

namespace polyfem {

/// The rational functions of a strictly convex polygon; on a triangle the linear ones.
///
/// With a_k = A(x, v_k, v_k+1) and b_i = A(v_i-1, v_i, v_i+1) the weight of (6) is
///     w_i = b_i prod_{k != i-1, i} a_k = b_i P_{i-1} S_{i+1},   N_i = w_i / sum_j w_j,
/// where P and S are running products from the front and the back. They are carried with their gradients
/// and a common binary exponent apart, so nothing is divided, nothing under- or overflows, and values and
/// gradients are good to round-off on edges and at vertices as inside, at any size and offset, in O(n).
/// At a vertex the gradient is that of the linear triangle of its corner.
class Wachspress final : public Basis {
 public:
  std::string_view name() const override { return "wachspress"; }
  /// A corner that does not turn left. Exact.
  std::optional<Objection> find_objection(const PointsRef& polygon) const override;
  void evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const override;
};

/// It has no state: one is enough.
inline constexpr Wachspress wachspress;

}  // namespace polyfem
