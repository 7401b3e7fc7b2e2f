#include <polyfem/mesh/edge_midpoints.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>
#include <map>

namespace polyfem {
namespace {

/// All edges (first, middle, last) of quadratic cells, in the order of cells.
std::vector<std::array<int, 3>> all_edges(const PolygonMesh& quadratic) {
  std::vector<std::array<int, 3>> edges;
  for (int c = 0; c < quadratic.n_cells(); ++c) {
    const std::span<const int> nodes = quadratic.cell(c);
    if (nodes.size() % 2 != 0)
      throw Error("cell " + std::to_string(c) + " has " + std::to_string(nodes.size()) +
                  " vertices: quadratic cells have a corner and a midpoint in turn, see with_edge_midpoints");
    for (std::size_t k = 0; k < nodes.size(); k += 2)
      edges.push_back({nodes[k], nodes[k + 1], nodes[(k + 2) % nodes.size()]});
  }
  return edges;
}

}  // namespace

PolygonMesh with_edge_midpoints(const PolygonMesh& mesh) {
  require_numbering(mesh);
  const int n_corners = static_cast<int>(mesh.vertices.cols());
  std::vector<std::map<int, int>> middle_of(static_cast<std::size_t>(n_corners));  // by lower, higher end
  std::vector<Vec2> middles;
  PolygonMesh quadratic;
  quadratic.offsets.reserve(mesh.offsets.size());
  quadratic.indices.reserve(2 * mesh.indices.size());
  std::vector<int> nodes;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> corners = mesh.cell(c);
    nodes.clear();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int first = corners[k], second = corners[(k + 1) % corners.size()];
      const auto [low, high] = std::minmax(first, second);
      const auto [middle, is_new] = middle_of[static_cast<std::size_t>(low)].try_emplace(
          high, n_corners + static_cast<int>(middles.size()));
      if (is_new) middles.push_back((mesh.vertices.col(low) + mesh.vertices.col(high)) / 2);
      nodes.insert(nodes.end(), {first, middle->second});
    }
    quadratic.add_cell(nodes);
  }
  quadratic.vertices.resize(2, n_corners + static_cast<Index>(middles.size()));
  quadratic.vertices.leftCols(n_corners) = mesh.vertices;
  for (std::size_t k = 0; k < middles.size(); ++k)
    quadratic.vertices.col(n_corners + static_cast<Index>(k)) = middles[k];
  return quadratic;
}

std::vector<std::array<int, 3>> quadratic_boundary_edges(const PolygonMesh& quadratic, const Region& region) {
  std::vector<std::array<int, 2>> halves = boundary_edges(quadratic);
  std::sort(halves.begin(), halves.end());
  const auto inside = [&](int v) { return region(quadratic.vertices.col(v)); };
  std::vector<std::array<int, 3>> edges = all_edges(quadratic);
  std::erase_if(edges, [&](const std::array<int, 3>& edge) {
    return !std::binary_search(halves.begin(), halves.end(), std::array{edge[0], edge[1]}) ||
           !std::all_of(edge.begin(), edge.end(), inside);
  });
  return edges;
}

std::vector<std::array<int, 3>> quadratic_edges(const PolygonMesh& quadratic,
                                                std::span<const std::array<int, 2>> edges) {
  std::map<std::array<int, 2>, int> middle_of;
  for (const auto& [first, middle, last] : all_edges(quadratic)) middle_of[{first, last}] = middle;
  std::vector<std::array<int, 3>> result;
  for (const std::array<int, 2>& edge : edges) {
    const auto found = middle_of.find(edge);
    if (found == middle_of.end())
      throw Error("no quadratic cell has an edge from vertex " + std::to_string(edge[0]) + " to vertex " +
                  std::to_string(edge[1]) + ": give edges of the mesh before with_edge_midpoints");
    result.push_back({edge[0], found->second, edge[1]});
  }
  return result;
}

}  // namespace polyfem
