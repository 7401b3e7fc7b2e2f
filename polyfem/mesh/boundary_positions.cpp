#include <polyfem/mesh/boundary_positions.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>

namespace polyfem {

namespace {

bool lies_on(const BoundaryPosition& position, int edge, int n_corners) {
  if (position.edge >= 0) return position.edge == edge;
  return position.corner >= 0 && (position.corner == edge || position.corner == (edge + 1) % n_corners);
}

BoundaryPosition position_of(const Vec2& x, const PointsRef& domain, double tolerance) {
  const Index n = domain.cols();
  BoundaryPosition position;
  double nearest = tolerance;
  for (Index k = 0; k < n; ++k) {
    const Vec2 start = domain.col(k), edge = domain.col((k + 1) % n) - start;
    if ((x - start).norm() <= tolerance) return {static_cast<int>(k), -1};
    const double along = std::clamp(edge.dot(x - start) / edge.squaredNorm(), 0.0, 1.0);
    const double distance = (start + along * edge - x).norm();
    if (distance <= nearest) {
      nearest = distance;
      position.edge = static_cast<int>(k);
    }
  }
  return position;
}

}  // namespace

std::optional<int> common_edge(const BoundaryPosition& a, const BoundaryPosition& b, int n_corners) {
  if (a.edge >= 0) return lies_on(b, a.edge, n_corners) ? std::optional(a.edge) : std::nullopt;
  if (a.corner < 0) return std::nullopt;
  for (const int edge : {a.corner, (a.corner + n_corners - 1) % n_corners})
    if (lies_on(b, edge, n_corners)) return edge;
  return std::nullopt;
}

std::vector<BoundaryPosition> boundary_positions(PolygonMesh& mesh, const PointsRef& domain,
                                                 double tolerance) {
  const int n_corners = static_cast<int>(domain.cols());
  const std::vector<std::array<int, 2>> edges = boundary_edges(mesh);
  std::vector<BoundaryPosition> positions(mesh.vertices.cols());
  std::vector<bool> met(n_corners);
  for (const auto& [first, second] : edges)
    for (const int vertex : {first, second}) {
      if (!positions[vertex].inside()) continue;
      const BoundaryPosition position = positions[vertex] =
          position_of(mesh.vertices.col(vertex), domain, tolerance);
      if (position.corner < 0) continue;
      mesh.vertices.col(vertex) = domain.col(position.corner);
      met[position.corner] = true;
    }
  for (const auto& [first, second] : edges)
    if (!common_edge(positions[first], positions[second], n_corners))
      throw Error("the cells of a mesh do not fit together");
  if (std::find(met.begin(), met.end(), false) != met.end())
    throw Error("the cells of a mesh do not reach all corners of the domain");
  return positions;
}

}  // namespace polyfem
