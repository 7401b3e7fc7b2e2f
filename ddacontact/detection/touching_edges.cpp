#include <ddacontact/detection/touching_edges.hpp>

#include <ddacontact/detection/directed_edge.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

std::vector<TouchingEdges> touching_edges(const polyfem::PointsRef& polygon, const polyfem::PointsRef& other,
                                          double near) {
  std::vector<TouchingEdges> found;
  for (Index i = 0; i < polygon.cols(); ++i) {
    const DirectedEdge edge(polygon, i);
    for (Index k = 0; k < other.cols(); ++k) {
      const Vec2 u = other.col(k), v = other.col((k + 1) % other.cols());
      if (std::abs(edge.gap(u)) > near || std::abs(edge.gap(v)) > near) continue;
      const auto [from, to] = std::minmax({edge.along(u), edge.along(v)});
      const double first = std::max(0.0, from), last = std::min(edge.length, to);
      if (last - first > near) found.push_back({i, k, first / edge.length, last / edge.length});
    }
  }
  return found;
}

}  // namespace ddacontact
