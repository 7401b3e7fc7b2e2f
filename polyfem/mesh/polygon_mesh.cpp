#include <polyfem/mesh/polygon_mesh.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>
#include <cstdint>

namespace polyfem {

std::span<const int> PolygonMesh::cell(int c) const {
  return std::span(indices).subspan(offsets[c], offsets[c + 1] - offsets[c]);
}

Points PolygonMesh::outline(int c) const {
  const std::span<const int> corners = cell(c);
  Points polygon(2, static_cast<Index>(corners.size()));
  for (std::size_t k = 0; k < corners.size(); ++k)
    polygon.col(static_cast<Index>(k)) = vertices.col(corners[k]);
  return polygon;
}

void PolygonMesh::add_cell(std::span<const int> corners) {
  indices.insert(indices.end(), corners.begin(), corners.end());
  offsets.push_back(static_cast<int>(indices.size()));
}

namespace {

/// An edge as a number: its lower vertex, its upper one, and whether it runs down. The two directions of an
/// edge become neighbours in a sorted list.
std::uint64_t edge_key(int from, int to) {
  const auto [low, high] = std::minmax(from, to);
  return static_cast<std::uint64_t>(low) << 33 | static_cast<std::uint64_t>(high) << 1 |
         (from > to ? 1u : 0u);
}

std::array<int, 2> edge_of(std::uint64_t key) {
  const int low = static_cast<int>(key >> 33), high = static_cast<int>(key >> 1 & 0xffffffffu);
  return key & 1 ? std::array{high, low} : std::array{low, high};
}

}  // namespace

std::vector<std::array<int, 2>> boundary_edges(const PolygonMesh& mesh) {
  std::vector<std::uint64_t> keys;
  keys.reserve(mesh.indices.size());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> corners = mesh.cell(c);
    for (std::size_t k = 0; k < corners.size(); ++k)
      keys.push_back(edge_key(corners[k], corners[k + 1 < corners.size() ? k + 1 : 0]));
  }
  std::sort(keys.begin(), keys.end());
  if (std::adjacent_find(keys.begin(), keys.end()) != keys.end())
    throw Error("two cells of a mesh run along the same edge in the same direction");
  std::vector<std::array<int, 2>> edges;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (i + 1 < keys.size() && keys[i + 1] == (keys[i] | 1) && keys[i] != keys[i + 1])
      ++i;
    else
      edges.push_back(edge_of(keys[i]));
  }
  return edges;
}

}  // namespace polyfem
