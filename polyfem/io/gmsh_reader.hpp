/// \file Plane meshes of Gmsh: .msh files of version 2.2 and 4.1, ASCII.
#pragma once

#include <polyfem/mesh/named_mesh.hpp>

#include <filesystem>

namespace polyfem {

/// Reads triangles and quadrilaterals of first order as cells, in the file's order, and lines as edges.
/// Physical groups of surfaces become groups of cells, those of curves groups of edges; one without a name
/// has its number for a name. Elements without a group belong to none; an element written once for each of
/// its groups (version 2.2) is one cell. Vertices are the nodes that cells have, in the order of nodes.
/// Clockwise cells are turned round; z must be the same everywhere.
///
/// Throws FileError with file, line and cure for what is missing, damaged or of another form (binary files,
/// other versions, solids, elements of second order), for a named group of surfaces or curves without
/// elements, and for a line in a group that no cell has as an edge. Groups of points and of volumes are
/// passed over. See `require_valid` for defects of the mesh.
NamedMesh read_gmsh(const std::filesystem::path& path);

}  // namespace polyfem
