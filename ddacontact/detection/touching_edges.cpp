#include <ddacontact/detection/touching_edges.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

std::vector<TouchingEdges> touching_edges(const polyfem::PointsRef& polygon, const polyfem::PointsRef& other,
                                          double near) {
  std::vector<TouchingEdges> found;
  for (Index i = 0; i < polygon.cols(); ++i) {
    const Vec2 start = polygon.col(i), along = polygon.col((i + 1) % polygon.cols()) - start;
    const double length = along.norm();
    const Vec2 t = along / length, n(-t.y(), t.x());
    for (Index k = 0; k < other.cols(); ++k) {
      const Vec2 u = other.col(k) - start, v = other.col((k + 1) % other.cols()) - start;
      if (std::abs(n.dot(u)) > near || std::abs(n.dot(v)) > near) continue;
      const double from = std::max(0.0, std::min(t.dot(u), t.dot(v)));
      const double to = std::min(length, std::max(t.dot(u), t.dot(v)));
      if (to - from > near) found.push_back({i, k, from / length, to / length});
    }
  }
  return found;
}

}  // namespace ddacontact
