#include <polyfem/mesh/vertex_cells.hpp>

#include <numeric>

namespace polyfem {

VertexCells::VertexCells(const PolygonMesh& mesh)
    : first_(static_cast<std::size_t>(mesh.vertices.cols()) + 1), cells_(mesh.indices.size()) {
  for (const int v : mesh.indices) ++first_[v + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c)) cells_[next[v]++] = c;
}

}  // namespace polyfem
