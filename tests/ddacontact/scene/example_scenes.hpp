/// \file Good scenes that tests change, and small helpers around reading them.
#pragma once

#include <ddacontact/scene/reader.hpp>

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

namespace example_scenes {

using ddacontact::Problem;
using ddacontact::Scene;
using ddacontact::SceneReading;

/// Every table and every kind of value; the line numbers are those that bad_input.txt names.
inline constexpr std::string_view complete = R"(format = 1
title = "Complete"
[analysis]
mode = "dynamic"
steps = 35
time_step = 0.02
gravity = [0.0, -9.8]
block_model = "auto"
[contact]
normal_stiffness = 1.4e9
[[material]]
name = "rock"
density = 2500.0
young = 35e6
poisson = 0.3
[[material]]
name = "soil"
unit_weight = "21 kN/m3"
young = "5 MPa"
poisson = 0.2
[[joint]]
name = "interface"
friction_angle = 30.0
[[joint]]
name = "weak"
between = ["rock", "soil"]
cohesion = "1 kPa"
[[block]]
name = "base"
material = "soil"
vertices = [[0.0, -1.0], [8.0, -1.0], [8.0, 0.0], [0.0, 0.0]]
fixed = [0, 1]
[[block]]
name = "slider"
material = "rock"
vertices = [[1.0, 0.0], [5.0, 0.0],
            [5.0, 2.0], [1.0, 2.0]]
model = "affine"
velocity = [0.1, 0.0]
angular_velocity = "5 deg/s"
stress = [0.0, "-1 kPa", 0.0]
[[block]]
material = "rock"
vertices = [[6.0, 0.0], [7.0, 0.0], [6.5, "90 cm"]]
[[support]]
block = "base"
vertices = [2, 3]
axes = "x"
displacement = [0.1, 0.0]
[[support]]
block = 2
vertices = [0]
history = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0]]
[[load]]
type = "point"
block = "slider"
at = [2.0, 2.0]
force = ["1 kN", -50.0]
[[load]]
type = "pressure"
block = "slider"
edge = 1
value = "2 kPa"
[[load]]
type = "body"
block = "2"
force = ["1 kN/m3", 0.0]
[[monitor]]
name = "centre"
block = "slider"
at = "centroid"
[[monitor]]
name = "corner"
block = "slider"
vertex = 3
[[monitor]]
name = "top"
block = "slider"
at = [3.0, 2.0]
[output]
every = 5
fields = ["displacement"]
)";

/// The least a scene needs.
inline constexpr std::string_view minimal = R"([analysis]
steps = 1
time_step = 0.01
[[material]]
name = "rock"
density = 2500
young = 1e9
poisson = 0.25
[[block]]
material = "rock"
vertices = [[0, 0], [1, 0], [1, 1], [0, 1]]
)";

/// A run of three stages; the line numbers are those that bad_input.txt names.
inline constexpr std::string_view in_stages = R"([analysis]
time_step = 0.01
scheme = "newmark"
gamma = 0.6
[[stage]]
name = "settle"
mode = "static"
steps = 50
joints = { interface = { friction_angle = "89 deg" }, 1 = { cohesion = "2 kPa" } }
reset_displacements = true
[[stage]]
name = "excavate"
steps = 20
time_step = "5 ms"
gravity = [0.0, -10.0]
damping = { mass = 0.5 }
remove = ["pillar", 3]
[[stage]]
steps = 5
scheme = "decaying"
[stage.joints.interface]
dashpot = 0.1
[[material]]
name = "rock"
density = 2500
young = 1e9
poisson = 0.25
[[joint]]
name = "interface"
friction_angle = 30
[[joint]]
between = ["rock", "rock"]
tensile_strength = 5
[[block]]
name = "base"
material = "rock"
vertices = [[0, -1], [8, -1], [8, 0], [0, 0]]
fixed = true
[[block]]
name = "pillar"
material = "rock"
vertices = [[1, 0], [2, 0], [2, 1], [1, 1]]
[[block]]
name = "beam"
material = "rock"
vertices = [[0, 1], [4, 1], [4, 2], [0, 2]]
[[block]]
material = "rock"
vertices = [[3, 0], [4, 0], [4, 1], [3, 1]]
[[support]]
block = "beam"
vertices = [0]
axes = "x"
displacement = [0.1, 0.0]
[[monitor]]
name = "foot"
block = "pillar"
vertex = 0
)";

/// `text` with the only place where `from` stands replaced by `to`.
inline std::string replaced(std::string_view text, std::string_view from, std::string_view to) {
  std::string result(text);
  const auto location = result.find(from);
  EXPECT_NE(location, std::string::npos) << from;
  EXPECT_EQ(result.find(from, location + 1), std::string::npos) << from << " stands twice";
  return location == std::string::npos ? result : result.replace(location, from.size(), to);
}

/// Three blocks of 2 x 1 m in a row, the first one held; the bolt stands in lines 27 to 32.
inline const std::string row_of_three = R"(format = 1
[analysis]
steps = 3
time_step = 0.01
gravity = [0.0, -10.0]
[[material]]
name = "rock"
density = 2000.0
young = 1e9
poisson = 0.2
[[block]]
name = "a"
material = "rock"
vertices = [[0, 0], [2, 0], [2, 1], [0, 1]]
fixed = true
[[block]]
name = "b"
material = "rock"
vertices = [[2, 0], [4, 0], [4, 1], [2, 1]]
[[block]]
name = "c"
material = "rock"
vertices = [[4, 0], [6, 0], [6, 1], [4, 1]]
[[stage]]
steps = 3
[[bolt]]
name = "b1"
points = [[1, 0.5], [5, 0.5]]
area = "4 cm2"
young = "200 GPa"
pretension = "50 kN"
)";

inline const std::string grouted =
    replaced(row_of_three, "area", "type = \"grouted\"\nbond_stiffness = \"1 GN/m2\"\narea");

inline SceneReading read(std::string_view text, const std::vector<std::string>& settings = {}) {
  return ddacontact::read_scene_text(std::string(text), "scene.toml", settings);
}

inline std::string all_text(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) text += problem.text() + '\n';
  return text;
}

/// The scene, which must be good.
inline Scene scene_of(std::string_view text, const std::vector<std::string>& settings = {}) {
  const SceneReading reading = read(text, settings);
  EXPECT_TRUE(reading.scene) << all_text(reading.problems);
  return reading.scene.value_or(Scene{});
}

}  // namespace example_scenes
