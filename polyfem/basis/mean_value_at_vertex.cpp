#include <polyfem/basis/edge_area.hpp>
#include <polyfem/basis/mean_value_at_vertex.hpp>

#include <cmath>

namespace polyfem {
namespace {

/// tan(alpha / 2) for the angle alpha from d to e, whose cross product is c.
double half_angle_tangent(const Vec2& d, const Vec2& e, double c) {
  const double product = d.norm() * e.norm(), dot = d.dot(e);
  return dot < 0 ? (product - dot) / c : c / (product + dot);
}

/// Adds to N_i, and takes from N_j, so that the gradients sum to zero.
void add_gradient(const Vec2& gradient, Index i, Index j, Index row, ShapeTable& table) {
  table.dx(row, i) += gradient.x();
  table.dy(row, i) += gradient.y();
  table.dx(row, j) -= gradient.x();
  table.dy(row, j) -= gradient.y();
}

}  // namespace

void mean_value_at_vertex(const PointsRef& polygon, Index j, Index row, ShapeTable& table) {
  const Index n = polygon.cols(), before = (j + n - 1) % n, after = (j + 1) % n;
  const auto add = [&](Index i, const Vec2& gradient) { add_gradient(gradient, i, j, row, table); };
  table.values.row(row).setZero();
  table.values(row, j) = 1;
  table.dx.row(row).setZero();
  table.dy.row(row).setZero();

  const Vec2 in = polygon.col(j) - polygon.col(before), out = polygon.col(after) - polygon.col(j);
  const auto edge = [&](Index i) { return PreciseEdge(polygon.col(i), polygon.col((i + 1) % n)); };
  const double l_in = in.norm(), l_out = out.norm(), area = cross(edge(before), edge(j))[0];
  if (in.dot(out) < 0 || std::abs(area) > straight_turn * l_in * l_out) {
    add(before, Vec2(-out.y(), out.x()) / area);
    add(after, Vec2(-in.y(), in.x()) / area);
    return;
  }
  const Vec2 normal = (in / l_in + out / l_out).normalized(), bisector(-normal.y(), normal.x());
  const double sin_phi = normal.dot(out) / l_out, cos_phi = bisector.dot(out) / l_out;
  add(before, (bisector - normal / sin_phi) / (2 * l_in));
  add(after, (bisector + normal / sin_phi) / (2 * l_out));
  const Vec2 of_weight = bisector * ((1 - cos_phi) / (2 * sin_phi));
  for (Index i = after; i != before; i = (i + 1) % n) {
    const Vec2 d = polygon.col(i) - polygon.col(j), e = polygon.col((i + 1) % n) - polygon.col(j);
    const double t = half_angle_tangent(d, e, edge(i).area(in_all_lanes(Vec2(polygon.col(j))))[0]);
    add(i, of_weight * (t / d.norm()));
    add((i + 1) % n, of_weight * (t / e.norm()));
  }
}

}  // namespace polyfem
