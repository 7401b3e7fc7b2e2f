#include <polyfem/mesh/polygon_mesh.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/mesh/edge_defects.hpp>

#include <algorithm>
#include <sstream>

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

bool PolygonMesh::offsets_fit() const {
  return !offsets.empty() && offsets.front() == 0 && std::is_sorted(offsets.begin(), offsets.end()) &&
         static_cast<std::size_t>(offsets.back()) == indices.size();
}

std::string PolygonMesh::vertex_name(int v) const {
  std::ostringstream text;
  text << "vertex " << v << " at (" << vertices(0, v) << ", " << vertices(1, v) << ")";
  return text.str();
}

void require_numbering(const PolygonMesh& mesh) {
  if (!mesh.offsets_fit())
    throw Error("the offsets of a mesh's cells must rise from 0 to the number of indices, " +
                std::to_string(mesh.indices.size()) + ": add cells by add_cell");
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c))
      if (v < 0 || v >= mesh.vertices.cols())
        throw Error("cell " + std::to_string(c) + " has a vertex " + std::to_string(v) +
                    ", but vertices are numbered 0 to " + std::to_string(mesh.vertices.cols() - 1) +
                    ": correct the number, or add the vertex");
}

std::vector<std::array<int, 2>> boundary_edges(const PolygonMesh& mesh) {
  require_numbering(mesh);
  std::vector<CellEdge> edges;
  edges.reserve(mesh.indices.size());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> corners = mesh.cell(c);
    for (std::size_t k = 0; k < corners.size(); ++k)
      edges.push_back({corners[k], corners[k + 1 < corners.size() ? k + 1 : 0], c});
  }
  const UnpairedEdges unpaired = unpaired_edges(edges, static_cast<int>(mesh.vertices.cols()));
  if (!unpaired.overlaps.empty()) throw Error(description(unpaired.overlaps.front(), mesh));
  std::vector<std::array<int, 2>> boundary;
  for (const CellEdge& edge : unpaired.single) boundary.push_back({edge.from, edge.to});
  return boundary;
}

}  // namespace polyfem
