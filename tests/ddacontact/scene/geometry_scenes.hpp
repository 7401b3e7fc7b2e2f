/// \file Scenes whose blocks come from a geometry file that a test writes.
#pragma once

#include "example_scenes.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace geometry_scenes {

using namespace example_scenes;

/// Two materials and no block.
inline constexpr std::string_view without_blocks = R"([analysis]
steps = 1
time_step = 0.01
[[material]]
name = "rock"
density = 2500
young = 1e9
poisson = 0.25
[[material]]
name = "soil"
density = 2000
young = 1e8
poisson = 0.25
)";

/// Blocks for it.
inline constexpr std::string_view good_json = R"({"type": "FeatureCollection", "features": [
{"type": "Feature", "properties": {"name": "base", "fixed": [0, 1]}, "geometry":
  {"type": "Polygon", "coordinates": [[[0, -1], [8, -1], [8, 0], [0, 0], [0, -1]]]}},
{"type": "Feature", "properties": {"name": "slider", "material": "soil", "model": "affine"}, "geometry":
  {"type": "MultiPolygon", "coordinates": [[[[1, 0], [5, 0], [5, 2], [1, 2], [1, 0]]]]}}
]})";

inline constexpr std::string_view good_wkt = R"(# a wall
POLYGON ((0 -1, 8 -1, 8 0, 0 0, 0 -1))
MULTIPOLYGON (((1 0, 5 0, 5 2, 1 2, 1 0)),
              ((6 0, 7 0, 6 1, 6 0)))
)";

/// A directory that lasts as long as the test.
class GeometryScenes : public testing::Test {
 protected:
  GeometryScenes() : directory_(testing::TempDir()) {
    directory_ /= "polydda_geometry_" + std::to_string(getpid());
    std::filesystem::create_directories(directory_);
  }
  ~GeometryScenes() override { std::filesystem::remove_all(directory_); }

  const std::filesystem::path& directory() const { return directory_; }
  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  void write(const std::string& name, std::string_view text) const {
    // A new file: some file systems flush one that is cut to nothing and written again.
    std::filesystem::remove(directory_ / name);
    std::ofstream(directory_ / name, std::ios::binary) << text;
  }

  /// The scene `rest` with the blocks of a file of this name and text.
  SceneReading read_with(const std::string& name, std::string_view text,
                         std::string_view rest = without_blocks,
                         const std::vector<std::string>& settings = {}) const {
    write(name, text);
    return ddacontact::read_scene_text("blocks = \"" + name + "\"\n" + std::string(rest), "scene.toml",
                                       settings, directory_);
  }
  Scene scene_with(const std::string& name, std::string_view text,
                   std::string_view rest = without_blocks) const {
    const SceneReading reading = read_with(name, text, rest);
    EXPECT_TRUE(reading.scene) << all_text(reading.problems) << text;
    EXPECT_TRUE(reading.problems.empty()) << all_text(reading.problems);
    return reading.scene.value_or(Scene{});
  }

  std::filesystem::path directory_;
};

}  // namespace geometry_scenes
