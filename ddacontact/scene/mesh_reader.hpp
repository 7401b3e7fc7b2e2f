/// \file Blocks from the cells of a mesh file: Gmsh's .msh and VTK's .vtu.
#pragma once

#include <ddacontact/scene/geometry_file.hpp>

#include <string>

namespace ddacontact::scene_format {

/// Whether the ending of the path is .msh or .vtu.
bool is_mesh_file(const std::string& path);

/// Each cell as a block, in the order of the file, in the groups of cells that it belongs to (physical
/// surfaces of Gmsh, arrays "cells:NAME" of .vtu). What the file has wrong is a problem with its line.
GeometryBlocks read_mesh_blocks(const std::string& path, ProblemList& problems);

}  // namespace ddacontact::scene_format
