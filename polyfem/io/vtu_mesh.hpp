/// \file Plane meshes from .vtu files, as MeshFile, ParaView, VTK and meshio write them.
#pragma once

#include <polyfem/mesh/named_mesh.hpp>

#include <filesystem>

namespace polyfem {

/// Reads polygons, triangles and quadrilaterals as cells. Vertices keep their numbers and z must be the same
/// everywhere; clockwise cells are turned round. Groups are those that a MeshFile of a NamedMesh holds:
/// arrays "cells:NAME" of CellData, not 0 for the cells of the group, and "edges:NAME" of FieldData, two
/// vertices an edge. Throws FileError with file, line and cure for what is damaged, of another kind or not
/// plane, for a group of edges that no cell has, and for an empty group. See `require_valid` for defects of
/// the mesh.
NamedMesh read_vtu_mesh(const std::filesystem::path& path);

}  // namespace polyfem
