/// \file Polygons that share their vertices.
#pragma once

#include <polyfem/core/types.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace polyfem {

/// Cells as lists of vertex indices, counter-clockwise, all in one array.
struct PolygonMesh {
  Points vertices;  ///< one a column
  std::vector<int> offsets{
      0};  ///< cell c owns indices[offsets[c]] up to, not including, indices[offsets[c + 1]]
  std::vector<int> indices;

  int n_cells() const { return static_cast<int>(offsets.size()) - 1; }
  std::span<const int> cell(int c) const;
  /// The polygon of a cell, counter-clockwise.
  Points outline(int c) const;
  void add_cell(std::span<const int> corners);
  /// Whether the offsets rise from 0 to the number of indices, so that they divide these into cells.
  bool offsets_fit() const;
  /// "vertex 5 at (1, 2)", for messages.
  std::string vertex_name(int v) const;
};

/// Throws Error when the offsets do not divide the indices into cells, or an index is out of range.
void require_numbering(const PolygonMesh& mesh);

/// The edges that belong to one cell only, as (first, second) vertex in that cell's direction. Throws Error
/// when two cells run along an edge in the same direction, as cells that overlap do, and for what
/// `require_numbering` refuses.
std::vector<std::array<int, 2>> boundary_edges(const PolygonMesh& mesh);

}  // namespace polyfem
