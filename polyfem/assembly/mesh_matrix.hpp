/// \file Sparse symmetric matrix of a field on a mesh: unknowns at vertices, coupled within cells.
#pragma once

#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/mesh/polygon_mesh.hpp>

#include <span>
#include <vector>

namespace polyfem {

/// The lower triangle of a sum over the cells of a mesh. Unknown c of vertex v has number n_components v + c.
///
/// The pattern is that of the vertices, with a block of n_components x n_components for each pair that shares
/// a cell. Where the blocks of each cell go is noted while the pattern is made, so that assembly does not
/// search.
class MeshMatrix {
 public:
  /// \param[in] mesh  kept by reference: must live longer, unchanged but for the places of its vertices. Its
  ///                  indices in range, no vertex twice in a cell.
  MeshMatrix(const PolygonMesh& mesh, int n_components);

  void set_zero();
  /// Adds the matrix of a cell, its unknowns in the order of the cell's vertices; reads the lower triangle.
  void add(int cell, const MatrixXd& K);

  const SparseMatrix& lower() const { return lower_; }
  SparseMatrix& lower() { return lower_; }

  /// Where the neighbours of each vertex begin, and where the last ones end.
  std::span<const int> first_neighbours() const { return first_block_; }
  /// The vertices from v on that vertex v shares a cell with, ascending, v itself included; of all vertices.
  std::span<const int> neighbours() const { return block_row_; }

 private:
  void find_blocks();
  void make_pattern();
  template <int fixed_n>  ///< the number of components, or 0 for any
  void add_blocks(int cell, const MatrixXd& K);

  const PolygonMesh* mesh_;
  int n_components_;
  std::vector<int> first_block_;  ///< column v has blocks first_block_[v] .. first_block_[v + 1] - 1
  std::vector<int> block_row_;    ///< the vertex of each block's rows: ascending in a column, v itself first
  std::vector<int> first_pair_;   ///< of each cell in block_of_pair_
  std::vector<int> block_of_pair_;  ///< for each pair i >= j of a cell's corners, j slowest
  SparseMatrix lower_;
};

}  // namespace polyfem
