/// \file Which scenes the regression table is about.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace regression {

/// How far round-off may be seen in the answers of a scene.
enum class SceneClass {
  smooth,   ///< rest, sliding, flight, vibration: nothing enlarges a small difference
  impacts,  ///< blocks meet: a small difference of when and how becomes one of the motion
  chaotic   ///< many blocks meet: small differences grow exponentially, only a short run can be compared
};

/// One scene of the list.
struct ListedScene {
  std::string name;
  SceneClass scene_class = SceneClass::smooth;
  std::filesystem::path file;
  std::vector<std::string> settings;                       ///< as `--set` takes them
  std::vector<std::pair<std::string, std::string>> pairs;  ///< of blocks whose contact forces are compared
};

/// What is compared of a result, relative to the scale of the scene: 1e-6, 1e-4, 1e-3.
double relative_tolerance(SceneClass scene_class);

/// Reads `file` (columns `scene,class,file,settings,pairs`; paths relative to it, settings and pairs
/// separated by spaces, a pair written `a/b`). Throws Error for what is not so.
std::vector<ListedScene> read_scene_list(const std::filesystem::path& file);

}  // namespace regression
