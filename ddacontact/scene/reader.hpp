/// \file Scene files (TOML) to scenes, with every problem of the file named at once.
#pragma once

#include <ddacontact/scene/problem.hpp>
#include <ddacontact/scene/scene.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// A scene, or why there is none.
struct SceneReading {
  std::optional<Scene> scene;     ///< set when no problem is an error
  std::vector<Problem> problems;  ///< in the order of the file; warnings too (polygons turned around, ...)
  bool unreadable = false;        ///< the file itself, or one that it names, could not be read
};

/// Reads and checks everything a run needs. Each `settings` entry is "PATH=VALUE" with a dotted path, array
/// elements by index or by name (`joint.0.friction_angle=15`, `block.slider.model=affine`); it replaces or
/// adds a value before the scene is checked. Never throws for a bad file.
/// \param goes_on  the scene is to be the next stage of a run: there are forces at its start
SceneReading read_scene(const std::string& path, const std::vector<std::string>& settings = {},
                        bool goes_on = false);

/// The same for a text; `name` stands in the messages, and files that the text names are looked for from
/// `directory` (empty: the current one).
SceneReading read_scene_text(const std::string& text, const std::string& name,
                             const std::vector<std::string>& settings = {},
                             const std::filesystem::path& directory = {}, bool goes_on = false);

}  // namespace ddacontact
