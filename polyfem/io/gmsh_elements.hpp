/// \file What a .msh file says, before a mesh is made of it.
#pragma once

#include <polyfem/core/types.hpp>
#include <polyfem/io/line_reader.hpp>

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace polyfem {

/// A line, triangle or quadrilateral.
struct GmshElement {
  std::vector<int> nodes;            ///< tags
  std::vector<int> physical_groups;  ///< tags
  int line;                          ///< of the file
};

/// A physical group that has a name.
struct GmshGroup {
  std::string name;
  int line;
};

/// The sections of a file that matter here.
struct GmshFile {
  std::vector<int> node_tags;           ///< in the file's order
  std::unordered_map<int, Vec2> nodes;  ///< by tag
  std::vector<GmshElement> lines, cells;
  std::map<int, GmshGroup> line_groups, cell_groups;  ///< by tag
};

/// Reads version 2.2 or 4.1. Throws FileError, see `read_gmsh`.
GmshFile read_gmsh_file(LineReader& in);

}  // namespace polyfem
