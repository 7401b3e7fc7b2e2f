/// \file Which cells meet at each vertex.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// The cells at each vertex of a mesh whose indices are in range; made in time proportional to its size.
class VertexCells {
 public:
  explicit VertexCells(const PolygonMesh& mesh);
  /// The cells at a vertex, ascending.
  std::span<const int> operator[](int vertex) const {
    return std::span(cells_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<int> first_, cells_;  ///< those of vertex v begin at first_[v]
};

}  // namespace polyfem
