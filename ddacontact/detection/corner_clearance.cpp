#include <ddacontact/detection/corner_clearance.hpp>

namespace ddacontact {

double distance_to_edge(const Vec2& point, const Vec2& start, const Vec2& end) {
  const Vec2 edge = end - start;
  const double square = edge.squaredNorm(),
               along = square > 0 ? std::clamp(edge.dot(point - start) / square, 0.0, 1.0) : 0;
  return (start + along * edge - point).norm();
}

double distance_to_outline(const Vec2& point, const PointsRef& outline) {
  double nearest = inf;
  for (Index k = 0; k < outline.cols(); ++k)
    nearest =
        std::min(nearest, distance_to_edge(point, outline.col(k), outline.col((k + 1) % outline.cols())));
  return nearest;
}

}  // namespace ddacontact
