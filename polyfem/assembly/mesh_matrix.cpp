#include <polyfem/assembly/mesh_matrix.hpp>

#include <polyfem/mesh/vertex_cells.hpp>

#include <algorithm>
#include <cassert>

namespace polyfem {
namespace {

/// The place of the pair (i, j) of n corners among pairs with i >= j, j slowest.
std::size_t pair_number(std::size_t i, std::size_t j, std::size_t n) {
  if (i < j) std::swap(i, j);
  return j * n - j * (j + 1) / 2 + i;
}

}  // namespace

MeshMatrix::MeshMatrix(const PolygonMesh& mesh, int n_components)
    : mesh_(&mesh), n_components_(n_components) {
  assert(n_components >= 1);
  find_blocks();
  make_pattern();
}

void MeshMatrix::find_blocks() {
  first_pair_.assign(1, 0);
  for (int c = 0; c < mesh_->n_cells(); ++c) {
    const int n = mesh_->offsets[c + 1] - mesh_->offsets[c];
    first_pair_.push_back(first_pair_.back() + n * (n + 1) / 2);
  }
  block_of_pair_.resize(first_pair_.back());

  const VertexCells cells(*mesh_);
  const int n_vertices = static_cast<int>(mesh_->vertices.cols());
  std::vector<int> last_column(n_vertices, -1), block_at(n_vertices);
  first_block_.assign(1, 0);
  for (int v = 0; v < n_vertices; ++v) {
    const std::size_t first = block_row_.size();
    block_row_.push_back(v);
    last_column[v] = v;
    for (const int c : cells[v])
      for (const int w : mesh_->cell(c))
        if (w > v && last_column[w] != v) {
          last_column[w] = v;
          block_row_.push_back(w);
        }
    std::sort(block_row_.begin() + static_cast<std::ptrdiff_t>(first), block_row_.end());
    for (std::size_t block = first; block < block_row_.size(); ++block)
      block_at[block_row_[block]] = static_cast<int>(block);
    first_block_.push_back(static_cast<int>(block_row_.size()));

    for (const int c : cells[v]) {
      const std::span<const int> corners = mesh_->cell(c);
      const auto i = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
      int* const block_of_pair = block_of_pair_.data() + first_pair_[c];
      for (std::size_t j = 0; j < corners.size(); ++j)
        if (corners[j] >= v) block_of_pair[pair_number(i, j, corners.size())] = block_at[corners[j]];
    }
  }
}

// Column a of vertex v has entries for components a .. n - 1 of v itself and for all n of each further block.
void MeshMatrix::make_pattern() {
  const int n = n_components_, n_vertices = static_cast<int>(first_block_.size()) - 1;
  lower_.resize(n * n_vertices, n * n_vertices);
  lower_.resizeNonZeros(Index{n} * n * first_block_.back() - Index{n} * (n - 1) / 2 * n_vertices);
  int* outer = lower_.outerIndexPtr();
  int* row = lower_.innerIndexPtr();
  for (int v = 0; v < n_vertices; ++v)
    for (int a = 0; a < n; ++a) {
      for (int b = a; b < n; ++b) *row++ = n * v + b;
      for (int block = first_block_[v] + 1; block < first_block_[v + 1]; ++block)
        for (int b = 0; b < n; ++b) *row++ = n * block_row_[block] + b;
      *++outer = static_cast<int>(row - lower_.innerIndexPtr());
    }
  set_zero();
}

void MeshMatrix::set_zero() {
  std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.);
}

void MeshMatrix::add(int cell, const MatrixXd& K) {
  switch (n_components_) {
    case 1:
      return add_blocks<1>(cell, K);
    case 2:
      return add_blocks<2>(cell, K);
    default:
      return add_blocks<0>(cell, K);
  }
}

template <int fixed_n>
void MeshMatrix::add_blocks(int cell, const MatrixXd& K) {
  const int n = fixed_n > 0 ? fixed_n : n_components_;
  const std::span<const int> corners = mesh_->cell(cell);
  const int n_corners = static_cast<int>(corners.size());
  assert(K.rows() == n * n_corners && K.cols() == n * n_corners);
  const int* block = block_of_pair_.data() + first_pair_[cell];
  const int* const outer = lower_.outerIndexPtr();
  for (int j = 0; j < n_corners; ++j)
    for (int i = j; i < n_corners; ++i, ++block) {
      const bool as_it_is = corners[i] >= corners[j];
      const int v = as_it_is ? corners[j] : corners[i];
      for (int a = 0; a < n; ++a) {
        double* const column = lower_.valuePtr() + outer[n * v + a] + n * (*block - first_block_[v]) - a;
        for (int b = i == j ? a : 0; b < n; ++b)
          column[b] += as_it_is ? K(n * i + b, n * j + a) : K(n * i + a, n * j + b);
      }
    }
}

}  // namespace polyfem
