/// \file Scenes of a few blocks, filled in code.
#pragma once

#include <ddacontact/scene/builder.hpp>
#include <tests/support/polygons.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace support {

using namespace ddacontact;

inline double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

inline BlockDescription block(const Points& vertices, bool fixed = false) {
  BlockDescription b;
  b.vertices = vertices;
  b.fixed = fixed;
  return b;
}

/// The mechanics of the paper: increments on the current shape, Newmark (1/2, 1), Shi's open-close iteration
/// with plain penalty springs.
inline Scene paper_mechanics(Scene scene) {
  scene.analysis.kinematics = Kinematics::incremental;
  scene.analysis.scheme = Scheme::dda;
  scene.contact.method = ContactMethod::classic;
  scene.contact.penetration_tolerance = 0;
  return scene;
}

/// Rock (2000 kg/m3, 100 MPa, 0.25) without friction, gravity 10 m/s2 downwards, contact springs of 40 E;
/// with the mechanics of the paper.
inline Scene rock_scene(double time_step, int steps) {
  Scene scene = paper_mechanics({});
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.gravity = Vec2(0, -10);
  scene.materials = {{"rock", 2000, 1e8, 0.25}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 4e9;
  scene.contact.tangential_stiffness = 1.6e9;
  return scene;
}

/// The scene with the mechanics of the default preset, by that scheme.
inline Scene default_mechanics(Scene scene, Scheme scheme = Scheme::decaying) {
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = scheme;
  scene.contact.method = ContactMethod::staged;
  scene.contact.penetration_tolerance = 1e-6;
  return scene;
}

/// Stiff rock, of which blocks step as by default, by that scheme.
inline Scene default_mechanics(double time_step, Scheme scheme = Scheme::decaying) {
  Scene scene = default_mechanics(rock_scene(time_step, 1), scheme);
  scene.materials[0].young = 1e11;
  return scene;
}

inline TimeFunction constant(const Vec2& value) {
  return {TimeFunction::Kind::constant, value, {}};
}

inline Load point_load(int on, const Vec2& at, const TimeFunction& force) {
  return {"", Load::Kind::point, on, at, 0, force};
}
inline Load pressure_load(int on, int edge, double pressure) {
  return {"", Load::Kind::pressure, on, Vec2(0, 0), edge, constant({pressure, 0})};
}
inline Load body_load(int on, const TimeFunction& force) {
  return {"", Load::Kind::body, on, Vec2(0, 0), 0, force};
}

/// Makes the scene's steps; a failure of the test when the run stops.
inline void run(Stepper& stepper, int steps) {
  for (int k = 0; k < steps; ++k)
    ASSERT_TRUE(stepper.step()) << "step " << k << ": " << stepper.stop_reason();
}

inline BuiltScene run(const Scene& scene) {
  BuiltScene built = build(scene);
  run(*built.stepper, scene.n_steps());
  return built;
}

/// The stepper's blocks, for steps that the test itself makes of them.
inline BlockSystem& blocks_of(BuiltScene& built) {
  return const_cast<BlockSystem&>(built.stepper->blocks());
}

inline StepRule rule_of(Scheme scheme) {
  StepRule rule;
  rule.scheme = scheme;
  return rule;
}
/// A step from the state, with no impact within.
inline StepStart step_start(const BlockState& state, double dt, const StepRule& rule = rule_of(Scheme::dda)) {
  return {rule, dt, state.velocity, state.carried};
}

inline Vec2 momentum(const Stepper& stepper, int b) {
  const Block& of = stepper.blocks().block(b);
  return of.mass_total() * rigid_velocity(of, stepper.state(), stepper.state().velocity).linear;
}

inline Vec2 centre(const Stepper& stepper, int b) {
  return stepper.blocks().block(b).centroid(stepper.state());
}

/// Where the centroid has moved to since the start.
inline Vec2 travel(const Stepper& stepper, int b) {
  return observe({"", Centroid{b}}, stepper).displacement;
}

}  // namespace support
