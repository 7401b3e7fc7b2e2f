#include <ddacontact/time/equilibrium.hpp>
#include <tests/ddacontact/time/trial_of.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// What is told of a block of 2000 kg in flight at (3, 4) m/s while supports exert this on a corner.
Equilibrium of_flight(const Vec2& reaction) {
  Scene scene;
  scene.analysis.time_step = 0.01;
  scene.analysis.steps = 1;
  scene.analysis.gravity = Vec2(0, -10);
  scene.materials = {{"rock", 2000, 1e9, 0.25}};
  scene.joints.resize(1);
  scene.blocks = {block(rectangle(0, 0, 1, 1))};
  scene.blocks[0].velocity = {3, 4};
  TrialOf step(scene);
  const TrialSolution solution = step.solve();
  Points reactions = Points::Zero(2, 4);
  reactions.col(0) = reaction;
  return find_equilibrium(step.trial.system(), solution, step.trial.contacts(), step.state, reactions,
                          step.state.velocity);
}

}  // namespace

TEST(Equilibrium, WhatFallsIsOutOfBalanceByItsWeight) {
  const Equilibrium e = of_flight({0, 0});
  EXPECT_NEAR(e.unbalanced, 1, 1e-9);
  EXPECT_EQ(e.unbalanced_block, 0);
  EXPECT_EQ(e.n_unbalanced, 1);
  EXPECT_FALSE(e.in_balance());
  EXPECT_NEAR(e.fastest, 5, 1e-12);
  EXPECT_NEAR(e.relative_speed, 5, 1e-12);
  EXPECT_NEAR(e.kinetic, 25e3, 1e-6);
}

TEST(Equilibrium, MeetsWhatIsAskedOfSpeedAndEnergyOnlyInBalance) {
  Equilibrium e = of_flight({0, 0});
  e.unbalanced = 0;
  EXPECT_TRUE(e.meets({.kinetic = 0.25, .displacement = 5.1}, 1e5));
  EXPECT_FALSE(e.meets({.kinetic = 0.25, .displacement = 4.9}, 1e5));
  EXPECT_FALSE(e.meets({.kinetic = 0.25, .displacement = std::nullopt}, 0.9e5));
  e.unbalanced = 1e-3;
  EXPECT_FALSE(e.meets({}, 1e5));
}
