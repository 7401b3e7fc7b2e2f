#include <polyfem/mesh/short_edges.hpp>

#include <algorithm>
#include <limits>
#include <tuple>
#include <vector>

namespace polyfem {

namespace {

struct Edge {
  double length;
  int low, high;
  bool of_thin_triangle;
  auto key() const { return std::tie(length, low, high, of_thin_triangle); }
};

/// Whether a cell is a triangle less than `height` high above its longest side.
bool is_thin_triangle(const MeshEditor& mesh, const std::vector<int>& corners, double height) {
  if (corners.size() != 3) return false;
  const Vec2 a = mesh.vertex(corners[0]), b = mesh.vertex(corners[1]), c = mesh.vertex(corners[2]);
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  return cross(b - a, c - a) < height * longest;
}

void add_edges(const MeshEditor& mesh, const std::vector<int>& corners, double shortest,
               std::vector<Edge>& edges) {
  const bool thin = is_thin_triangle(mesh, corners, shortest);
  Edge least{std::numeric_limits<double>::infinity(), 0, 0, thin};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto [low, high] = std::minmax(corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]);
    const Edge edge{mesh.length(low, high), low, high, thin};
    if (edge.length < least.length) least = edge;
    if (edge.length < shortest) edges.push_back({edge.length, low, high, false});
  }
  if (thin) edges.push_back(least);
}

/// The edges to collapse: short ones, and the shortest of each thin triangle.
std::vector<Edge> edges_to_collapse(const MeshEditor& mesh, double shortest) {
  std::vector<Edge> edges;
  for (int c = 0; c < mesh.n_cells(); ++c) add_edges(mesh, mesh.cell(c), shortest, edges);
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  return edges;
}

bool are_joined(const MeshEditor& mesh, int u, int v) {
  const std::vector<int> neighbours = mesh.neighbours(u);
  return std::binary_search(neighbours.begin(), neighbours.end(), v);
}

}  // namespace

void collapse_short_edges(MeshEditor& mesh, double shortest, double wanted_turn, int least_cells) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const Edge& edge : edges_to_collapse(mesh, shortest)) {
      // An edge of this list may have moved or gone with one before it.
      if (!are_joined(mesh, edge.low, edge.high)) continue;
      if (mesh.length(edge.low, edge.high) >= shortest && !edge.of_thin_triangle) continue;
      const bool may_vanish = mesh.n_cells() - mesh.n_vanished() > least_cells;
      if (mesh.collapse(edge.low, edge.high, wanted_turn, may_vanish)) changed = true;
    }
  }
}

}  // namespace polyfem
