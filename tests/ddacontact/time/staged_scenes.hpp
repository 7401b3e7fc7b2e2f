/// \file Blocks that settle, then move.
#pragma once

#include <tests/ddacontact/simple_scenes.hpp>

namespace support {

/// Default mechanics; a slider, 2 m x 1 m, on a fixed slope that rises to the left.
inline Scene slope_scene(double degrees, double friction_degrees) {
  Scene scene;
  scene.analysis.time_step = 0.01;
  scene.analysis.steps = 50;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", 2500, 35e9, 0.3}};
  scene.joints = {{"interface", friction_degrees, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * 35e9;
  scene.contact.tangential_stiffness = 16 * 35e9;
  const double angle = -radians(degrees);
  scene.blocks = {block(turned(rectangle(-2, -1, 20, 1), angle), true),
                  block(turned(rectangle(0, 0, 2, 1), angle))};
  return scene;
}

inline StageDescription settling(const Scene& scene, int steps) {
  StageDescription stage = scene.stage("settle");
  stage.analysis.mode = Mode::statics;
  stage.analysis.steps = steps;
  stage.joints[0].friction_angle = 89;
  stage.reset_displacements = true;
  return stage;
}

/// A beam of 5 m on two pillars of 1 m.
inline Scene beam_scene() {
  Scene scene = slope_scene(0, 30);
  scene.analysis.time_step = 0.005;
  scene.blocks = {block(rectangle(-5, -1, 20, 1), true), block(rectangle(0, 0, 1, 1)),
                  block(rectangle(4, 0, 1, 1)), block(rectangle(0, 1, 5, 1))};
  for (BlockDescription& b : scene.blocks) b.model = BlockModel::wachspress;
  return scene;
}

}  // namespace support
