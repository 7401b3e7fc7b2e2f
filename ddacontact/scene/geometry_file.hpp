/// \file Geometry files: blocks of a scene from polygons of GeoJSON, well-known text, drawings or meshes.
#pragma once

#include <ddacontact/scene/records.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// The ending of a path, in small letters: ".wkt".
std::string small_ending(const std::string& path);

struct GeometryBlocks {
  std::vector<BlockRecord> blocks;
  bool complete = false;    ///< every polygon has its place in `blocks`, invalid ones too
  bool unreadable = false;  ///< the file could not be read
};

/// Reads the file at `path`; its ending says what it is. `key` is the location of what names it, `key_name`
/// its name, for problems with the file as a whole; other problems have `path` for a file.
GeometryBlocks read_geometry_file(const std::string& path, const SourceLocation& key, ProblemList& problems,
                                  const std::string& key_name = "blocks");

/// Appends the blocks of the file that the key 'blocks' of a document names; `directory` is the scene's.
/// Returns whether the file could be read.
bool add_geometry(const std::filesystem::path& directory, Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
