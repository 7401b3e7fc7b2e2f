/// \file A mesh whose parts have names, as mesh generators give them.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace polyfem {

/// A mesh with named groups of cells (materials) and of edges (boundary conditions). A cell or edge may
/// belong to several groups or to none.
struct NamedMesh {
  PolygonMesh mesh;
  std::map<std::string, std::vector<int>> cell_groups;
  /// (first, second) vertex in the direction of a cell that has the edge, the only one on the boundary: as
  /// `FieldProblem::add_edge_loads` takes them.
  std::map<std::string, std::vector<std::array<int, 2>>> edge_groups;

  /// The cells of a group. Throws Error, with the names that there are, for another one.
  const std::vector<int>& cells(const std::string& group) const;
  /// The edges of a group, in the same way.
  const std::vector<std::array<int, 2>>& edges(const std::string& group) const;
  /// The vertices of a group's edges, ascending: to be held.
  std::vector<int> vertices(const std::string& edge_group) const;
};

}  // namespace polyfem
