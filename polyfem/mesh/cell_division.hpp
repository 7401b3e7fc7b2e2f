/// \file Refinement: cells divided into quadrilaterals, one at each corner.
#pragma once

#include <polyfem/mesh/named_mesh.hpp>

#include <vector>

namespace polyfem {

/// The mesh with the marked cells divided: a new vertex in the mean of the middles of a cell's sides is
/// joined to them. Parts of convex cells are convex. A side goes from corner to corner; vertices on it where
/// the cell turns by less than 14 degrees, as the middles that finer neighbours have and those of a curved
/// outline, belong to it, and one near its middle is used. Neighbours that are not divided get the new
/// middles as such vertices, so the mesh stays conforming: functions of `suitable_basis` are linear along
/// each part of a side.
///
/// Vertices and cells keep their order; the parts of a cell take its place. Throws Error for a number of
/// marks other than that of the cells, and for a marked cell that is not seen whole from there.
/// \param[out] first_child  cell c became cells first_child[c] .. first_child[c + 1] - 1; may be null
PolygonMesh divide_cells(const PolygonMesh& mesh, const std::vector<char>& marked,
                         std::vector<int>* first_child = nullptr);

/// The same of a mesh whose groups go on: the parts of a cell belong to its groups, the two parts of a halved
/// edge to those of the edge, in its direction.
NamedMesh divide_cells(const NamedMesh& named, const std::vector<char>& marked,
                       std::vector<int>* first_child = nullptr);

}  // namespace polyfem
