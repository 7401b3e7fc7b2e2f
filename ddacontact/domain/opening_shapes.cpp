#include <ddacontact/domain/opening_shapes.hpp>

#include <cmath>
#include <numbers>

namespace ddacontact {

Points circle_outline(const Vec2& centre, double radius, int n_edges) {
  Points outline(2, n_edges);
  for (Index k = 0; k < n_edges; ++k) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(k) / n_edges;
    outline.col(k) = centre + radius * Vec2(std::cos(angle), std::sin(angle));
  }
  return outline;
}

Points horseshoe_outline(const Vec2& floor, double width, double height, int n_edges) {
  const double radius = width / 2, wall = height - radius;
  const Index first = wall > 0 ? 2 : 0;
  Points outline(2, n_edges + 1 + first);
  if (wall > 0) outline.leftCols(2) << floor.x() - radius, floor.x() + radius, floor.y(), floor.y();
  for (Index k = 0; k <= n_edges; ++k) {
    const double angle = std::numbers::pi * static_cast<double>(k) / n_edges;
    outline.col(first + k) = floor + Vec2(radius * std::cos(angle), wall + radius * std::sin(angle));
  }
  outline.col(first + n_edges) = floor + Vec2(-radius, wall);  // not by way of sin(pi)
  return outline;
}

}  // namespace ddacontact
