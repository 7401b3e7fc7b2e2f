/// \file Changes a mesh of convex cells without breaking one.
#pragma once

#include <polyfem/mesh/boundary_positions.hpp>
#include <polyfem/mesh/polygon_mesh.hpp>

#include <vector>

namespace polyfem {

/// Moves and merges vertices. A change is made only when every cell around stays convex: cells that all turn
/// counter-clockwise around an unchanged surrounding cannot overlap, so the mesh keeps filling its domain.
///
/// "Turn" of a cell is the least sine by which one of its corners turns, see corner_turn.hpp.
class MeshEditor {
 public:
  MeshEditor(const PolygonMesh& mesh, std::vector<BoundaryPosition> positions, const Points& domain);

  /// Those that have vanished are counted too.
  int n_cells() const { return static_cast<int>(cells_.size()); }
  /// Corners of a cell, counter-clockwise; none when it has vanished.
  const std::vector<int>& cell(int c) const { return cells_[c]; }
  Vec2 vertex(int v) const { return vertices_.col(v); }
  double length(int u, int v) const { return (vertex(v) - vertex(u)).norm(); }
  double turn(int c) const;
  int n_vanished() const { return n_vanished_; }
  /// The vertices joined to v by an edge, in ascending order.
  std::vector<int> neighbours(int v) const;

  /// Merges the ends of an edge: at its middle or at one end, whichever leaves the best turn; corners of the
  /// domain stay and vertices on its edges stay on them. Returns false and changes nothing when the outline
  /// would change, when a triangle would vanish and `may_vanish` is false, or when a cell around would turn
  /// by less than `wanted_turn` and by less than the worst around did before.
  bool collapse(int u, int v, double wanted_turn, bool may_vanish);

  /// Moves a vertex as near to `target` as its place allows: not at all at a corner of the domain, along the
  /// edge on one. Returns false and changes nothing unless the least turn of the cells around grows.
  bool move(int v, const Vec2& target);

  /// The least turn of the cells around a vertex.
  double least_turn_around(int v) const;

  /// The mesh as it is now, without the cells that vanished; unused vertices stay.
  PolygonMesh mesh() const;
  const std::vector<BoundaryPosition>& positions() const { return positions_; }

 private:
  std::vector<Vec2> merged_positions(int u, int v) const;
  std::vector<int> cells_around(int u, int v) const;
  std::vector<int> merged_cell(int c, int u, int v) const;

  Points vertices_, domain_;
  std::vector<BoundaryPosition> positions_;
  int n_vanished_ = 0;
  std::vector<std::vector<int>> cells_, cells_of_;  ///< cells_of_[v]: those with corner v, ascending
};

}  // namespace polyfem
