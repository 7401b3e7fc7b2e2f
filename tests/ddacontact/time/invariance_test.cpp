#include <tests/ddacontact/simple_scenes.hpp>

#include <algorithm>

using namespace support;

namespace {

/// A pile that slides, tips over an edge and falls on: all vertices on a grid of 2^-10 m.
Scene pile(int steps = 120) {
  Scene scene = rock_scene(1. / 128, steps);
  scene.joints[0].friction_angle = 25;
  const auto on_grid = [](Points p) -> Points { return (p.array() * 1024).round() / 1024; };
  scene.blocks = {block(rectangle(0, -1, 3, 1), true),
                  block(on_grid(turned(rectangle(2.2, 0, 1.5, 0.8), 0.05, {2.2, 0}))),
                  block(rectangle(1, 1.125, 2, 0.5)),
                  block(on_grid(turned(rectangle(0.25, 0.25, 0.75, 0.75), 0.4, {0.5, 0.25})))};
  scene.blocks[1].velocity = {0.5, 0};
  scene.blocks[2].model = BlockModel::affine;
  return scene;
}

Scene changed(Scene scene, const Mat2& A, const Vec2& by) {
  for (BlockDescription& b : scene.blocks) {
    b.vertices = (A * b.vertices).colwise() + by;
    b.velocity = A * b.velocity;
  }
  scene.analysis.gravity = A * scene.analysis.gravity;
  return scene;
}

Points displacements(const BuiltScene& built) {
  return built.stepper->blocks().displacements(built.stepper->state());
}

void expect_same_counts(const Stepper& a, const Stepper& b) {
  EXPECT_EQ(a.counts().substeps, b.counts().substeps);
  EXPECT_EQ(a.counts().rejected, b.counts().rejected);
  EXPECT_EQ(a.counts().contact_iterations, b.counts().contact_iterations);
  EXPECT_EQ(a.counts().contacts_max, b.counts().contacts_max);
}

}  // namespace

TEST(Invariance, TwoRunsGiveTheSameBits) {
  const BuiltScene one = run(pile()), other = run(pile());
  EXPECT_EQ(one.stepper->state().position, other.stepper->state().position);
  EXPECT_EQ(one.stepper->state().velocity, other.stepper->state().velocity);
  EXPECT_EQ(one.stepper->state().stress, other.stepper->state().stress);
  EXPECT_EQ(one.stepper->reactions(), other.stepper->reactions());
  expect_same_counts(*one.stepper, *other.stepper);
}

/// The default mechanics, on a map, with coordinates that are multiples of 2^-20 m.
TEST(Invariance, AMapsOriginChangesNothingOfTheDefaultMechanics) {
  Scene scene = default_mechanics(pile());
  scene.blocks[3].vertices = (scene.blocks[3].vertices.array() + 1. / (1 << 20)).matrix();
  const BuiltScene here = run(scene), there = run(changed(scene, Mat2::Identity(), Vec2(5e5, 4e6)));
  expect_same_counts(*here.stepper, *there.stepper);
  EXPECT_GT(displacements(here).colwise().norm().maxCoeff(), 0.2);
  EXPECT_LE((displacements(here) - displacements(there)).colwise().norm().maxCoeff(), 1e-9 * 0.75);
}

/// Lengths by 2^k at the same time step: gravity and velocities by as much, stiffnesses and stresses by its
/// square.
TEST(Invariance, ScalingLengthsByPowersOfTwoScalesEverythingBitByBit) {
  const BuiltScene one = run(pile());
  for (double s : {1. / 1024, 64.}) {
    Scene scene = changed(pile(), s * Mat2::Identity(), Vec2::Zero());
    scene.materials[0].young *= s * s;
    scene.contact.normal_stiffness *= s * s;
    scene.contact.tangential_stiffness *= s * s;
    const BuiltScene scaled = run(scene);
    expect_same_counts(*one.stepper, *scaled.stepper);
    EXPECT_EQ(displacements(scaled), s * displacements(one)) << s;
    EXPECT_EQ(scaled.stepper->state().stress, s * s * one.stepper->state().stress) << s;
  }
}

TEST(Invariance, ScalingMassesByPowersOfTwoScalesForcesBitByBit) {
  const BuiltScene one = run(pile());
  Scene scene = pile();
  for (double* x : {&scene.materials[0].density, &scene.materials[0].young, &scene.contact.normal_stiffness,
                    &scene.contact.tangential_stiffness})
    *x *= 1 << 20;
  const BuiltScene scaled = run(scene);
  expect_same_counts(*one.stepper, *scaled.stepper);
  EXPECT_EQ(displacements(scaled), displacements(one));
  EXPECT_EQ(scaled.stepper->reactions(), (1 << 20) * one.stepper->reactions());
}

/// Ten steps: later a chaotic pile may part ways by round-off.
TEST(Invariance, TurningOrMirroringTheSceneTurnsTheResult) {
  const BuiltScene one = run(pile(10));
  Mat2 quarter, mirror;
  quarter << 0, -1, 1, 0;
  mirror << -1, 0, 0, 1;
  for (const Mat2& A : {quarter, Mat2(-Mat2::Identity()), Mat2(Eigen::Rotation2Dd(0.3))}) {
    const BuiltScene other = run(changed(pile(10), A, Vec2::Zero()));
    EXPECT_LE((displacements(other) - A * displacements(one)).norm(), 1e-10);
  }
  // A mirrored outline runs clockwise and is turned around: compare the centroids.
  const BuiltScene mirrored = run(changed(pile(10), mirror, Vec2::Zero()));
  for (int b = 0; b < 4; ++b)
    EXPECT_LE((travel(*mirrored.stepper, b) - mirror * travel(*one.stepper, b)).norm(), 1e-10);
}

TEST(Invariance, TheOrderOfBlocksDoesNotMatter) {
  const BuiltScene one = run(pile(10));
  Scene scene = pile(10);
  std::reverse(scene.blocks.begin(), scene.blocks.end());
  const BuiltScene other = run(scene);
  for (int b = 0; b < 4; ++b)
    EXPECT_LE((travel(*other.stepper, 3 - b) - travel(*one.stepper, b)).norm(), 1e-10);
}
