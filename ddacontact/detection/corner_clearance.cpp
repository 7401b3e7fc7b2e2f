#include <ddacontact/detection/corner_clearance.hpp>

#include <cmath>

namespace ddacontact {

double distance_from_outline(const Vec2& point, const PointsRef& outline) {
  double least = inf;
  for (Index v = 0; v < outline.cols(); ++v) {
    const Vec2 start = outline.col(v), along = outline.col((v + 1) % outline.cols()) - start;
    const double t = std::clamp((point - start).dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (start + t * along - point).squaredNorm());
  }
  return std::sqrt(least);
}

}  // namespace ddacontact
