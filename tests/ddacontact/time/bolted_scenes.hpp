/// \file Blocks on bolts.
#pragma once

#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/output/bolt_view.hpp>

namespace support {

/// A bar of 4 cm2 of steel.
inline RockBolt steel_bolt(const Vec2& from, const Vec2& to) {
  RockBolt bolt;
  bolt.name = "b1";
  bolt.from = from;
  bolt.to = to;
  bolt.area = 4e-4;
  bolt.young = 2e11;
  return bolt;
}

/// A block of 40 kN that hangs from a fixed one, 5 m below.
inline Scene hanging_block(double time_step, int steps) {
  Scene scene = default_mechanics(rock_scene(time_step, steps), Scheme::midpoint);
  scene.materials[0].young = 1e14;
  scene.blocks = {block(rectangle(0, 9.5, 2, 1), true), block(rectangle(0, 4.5, 2, 1))};
  scene.bolts = {steel_bolt({1, 10}, {1, 5})};
  return scene;
}
inline constexpr double weight = 40e3, bar_stiffness = 4e-4 * 2e11;

inline BoltView view_of(const Stepper& stepper, int bolt = 0) {
  return {stepper.blocks().bolts[static_cast<std::size_t>(bolt)], stepper.blocks(), stepper.state()};
}
inline double axial(const Stepper& stepper, int segment = 0) {
  return view_of(stepper).axial(segment);
}

/// Two blocks of 2 x 1 m face to face, the left one fixed, without weight, and a bar through both.
inline Scene bolted_pair() {
  Scene scene = hanging_block(1, 30);
  scene.analysis.mode = Mode::statics;
  scene.analysis.gravity = Vec2::Zero();
  scene.materials[0].young = 1e11;
  scene.blocks = {block(rectangle(0, 0, 2, 1), true), block(rectangle(2, 0, 2, 1))};
  scene.bolts = {steel_bolt({0.25, 0.5}, {3.75, 0.5})};
  return scene;
}
inline Scene grouted_pair() {
  Scene scene = bolted_pair();
  scene.bolts[0].kind = RockBolt::Kind::grouted;
  scene.bolts[0].bond_stiffness = 1e9;
  return scene;
}
/// The segment between the blocks.
inline int at_joint(const Bolt& bolt) {
  int k = 0;
  while (bolt.nodes[static_cast<std::size_t>(k)].block == bolt.nodes[static_cast<std::size_t>(k) + 1].block)
    ++k;
  return k;
}

inline double closed_contacts(const Stepper& stepper) {
  double sum = 0;
  for (const ddacontact::ContactRecord& contact : stepper.contacts()) sum += contact.normal;
  return sum;
}

inline void expect_closed(const Stepper& stepper, double tolerance = 1e-6) {
  EXPECT_LE(std::abs(stepper.energy().balance_error()), tolerance);
}

}  // namespace support
