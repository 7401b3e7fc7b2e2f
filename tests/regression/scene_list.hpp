/// \file Which scenes the regression table is about.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace regression {

/// One scene of the list.
struct ListedScene {
  std::string name;
  std::filesystem::path file;
  std::vector<std::string> settings;                       ///< as `--set` takes them
  std::vector<std::pair<std::string, std::string>> pairs;  ///< of blocks whose contact forces are compared
};

/// Reads `file` (columns `scene,file,settings,pairs`; paths relative to it, settings and pairs
/// separated by spaces, a pair written `a/b`). Throws Error for what is not so.
std::vector<ListedScene> read_scene_list(const std::filesystem::path& file);

}  // namespace regression
