/// \file Scenes of rock, and their factors of safety by strength reduction.
#pragma once

#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/study/strength_reduction.hpp>

namespace support {

inline constexpr double gravity = 9.81, density = 2500;

inline Scene rock(const Joint& joint) {
  Scene scene;
  scene.analysis.time_step = 0.01;
  scene.analysis.steps = 100;
  scene.analysis.gravity = Vec2(0, -gravity);
  scene.analysis.block_model = BlockModel::affine;
  scene.materials = {{"rock", density, 5e9, 0.25}};
  scene.joints = {joint};
  scene.contact.normal_stiffness = 2e11;
  scene.contact.tangential_stiffness = 8e10;
  return scene;
}

inline void add(Scene& scene, const Points& polygon, bool fixed = false) {
  scene.blocks.push_back(block(polygon, fixed));
  scene.blocks.back().model = BlockModel::affine;
}

inline FactorBracket factor_of(const Scene& scene, double tolerance = 0.004) {
  const StrengthReduction reduction(scene, {0});
  EXPECT_EQ(reduction.unsettled(), "");
  return bracket_factor([&](double f) { return reduction.try_factor(f).verdict; }, std::nullopt, tolerance);
}

}  // namespace support
