/// \file Mean value shape functions of any simple polygon.
#pragma once

#include <polyfem/basis/basis.hpp>

#include <optional>
#include <string_view>

namespace polyfem {

/// Floater's mean value functions, for concave polygons and vertices on edges too; on a triangle the linear
/// ones.
///
/// With d_i = v_i - x, rho_i = |d_i| and alpha_i the angle from d_i to d_i+1,
///     w_i = (t_{i-1} + t_i) / rho_i,   t_i = tan(alpha_i / 2),   N_i = w_i / sum_j w_j.
/// Towards edge k t_k grows without bound, so all weights are multiplied by c_k = cross(d_k, d_k+1), in which
/// c_k t_k = rho_k rho_k+1 - d_k . d_k+1 is smooth: values (absolute) and gradients (relative to the largest
/// at the point) are within 1e-14 of exact up to and on the edges, at any size and offset, in needles down to
/// a width of 1e-9 of their length (1e-12 of it: 1e-12), in O(n). On an edge the gradient is the limit from
/// inside. A point has the same bytes whatever the others.
///
/// Values are negative in places that a concave corner hides from the vertex. At a vertex the functions are
/// continuous but have no gradient; there it is *defined* as that of the linear triangle of the corner, the
/// only one that has the slopes of both edges. At a corner straighter than `straight_turn` that triangle is a
/// sliver or nothing, and the gradient is the limit along the bisector, which has the mean of both slopes.
class MeanValue final : public Basis {
 public:
  std::string_view name() const override { return "mean_value"; }
  /// A vertex in the place of the next one; nothing else is wrong with a simple polygon.
  std::optional<Rejection> find_rejection(const PointsRef& polygon) const override;
  void evaluate(const PointsRef& polygon, const PointsRef& points, ShapeTable& table) const override;
};

/// It has no state: one is enough.
inline constexpr MeanValue mean_value;

}  // namespace polyfem
