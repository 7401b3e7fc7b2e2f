/// \file Meshes as .off files (Object File Format), ASCII.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <filesystem>

namespace polyfem {

/// Reads the faces of a plane .off file as cells: vertices of one z, which is dropped; clockwise faces are
/// turned round; colours and comments are passed over. Vertices keep their numbers. Throws FileError with
/// file and line for what is missing, damaged or not plane. See `require_valid` for defects of the mesh.
PolygonMesh read_off(const std::filesystem::path& path);

/// Writes a mesh with z = 0 and as many digits as give the same numbers when read. Throws FileError; what was
/// written is then removed.
void write_off(const std::filesystem::path& path, const PolygonMesh& mesh);

}  // namespace polyfem
