#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/block/system_part.hpp>

using namespace support;

namespace {

Scene four_blocks() {
  Scene scene = rock_scene(0.01, 1);
  scene.analysis.kinematics = Kinematics::corotational;
  for (int k = 0; k < 4; ++k) scene.blocks.push_back(block(rectangle(2 * k, 0, 1 + 0.1 * k, 1), k == 1));
  scene.loads = {point_load(0, Vec2(0.5, 0.5), constant(Vec2(1, 0))),
                 point_load(2, Vec2(4.5, 0.5), constant(Vec2(0, 3)))};
  return scene;
}

}  // namespace

TEST(SystemPart, IsASystemOfItsOwnWhoseStateIsReadAndWritten) {
  BuiltScene built = build(four_blocks());
  BlockSystem& whole = blocks_of(built);
  BlockState of_whole = built.stepper->state();
  of_whole.velocity = VectorXd::LinSpaced(32, 0, 31);
  of_whole.rotation = VectorXd::LinSpaced(4, 0, 3);
  const BlockState before = of_whole;
  BlockSystem::Part part(whole, {1, 2, 3}, {0, 0, 0, 1});
  EXPECT_EQ(part.number_of(2), 1);
  EXPECT_EQ(part.number_of(0), -1);
  part.read(whole, of_whole);
  const BlockSystem& system = part.system();
  BlockState& state = part.state();
  EXPECT_EQ(system.n_blocks(), 3);
  EXPECT_EQ(system.n_unknowns(), 24);
  EXPECT_EQ(system.n_equations(), 8) << "one is held and one rests";
  EXPECT_TRUE(system.is_movable(1) && system.is_free(1));
  EXPECT_FALSE(system.is_movable(0) || system.is_movable(2) || system.is_free(2));
  EXPECT_TRUE(system.is_unchanging(0) && system.is_unchanging(2));
  EXPECT_EQ(system.block(1).unknowns().first, 8);
  EXPECT_EQ(state.velocity, before.velocity.tail(24));
  EXPECT_EQ(system.positions(state), whole.positions(of_whole).rightCols(12));
  EXPECT_EQ(system.names[0], "1");
  VectorXd F = VectorXd::Zero(24);
  system.add_loads(state, 0, F);
  EXPECT_NEAR(F.sum(), 3, 1e-12);
  EXPECT_NEAR(F.segment(8, 8).sum(), 3, 1e-12);
  EXPECT_EQ(system.prescribed(state, 0).norm(), 0);

  state.velocity.segment(8, 8).setConstant(7);
  state.position(0, 5) += 1;
  state.time = 5;
  part.write(whole, of_whole);
  EXPECT_EQ(whole.block(3).unknowns().first, 24) << "its blocks have kept their numbers";
  EXPECT_EQ(of_whole.time, 5);
  BlockState expected = before;
  expected.velocity.segment(16, 8).setConstant(7);
  expected.position(0, 9) += 1;
  EXPECT_EQ(of_whole.velocity, expected.velocity);
  EXPECT_EQ(of_whole.position, expected.position);
  EXPECT_EQ(of_whole.rotation, expected.rotation);
}

TEST(SystemPart, HasTheBlocksOfTheWholeInTheirShapes) {
  Scene scene = four_blocks();
  scene.analysis.kinematics = Kinematics::incremental;
  BuiltScene built = build(scene);
  BlockSystem& whole = blocks_of(built);
  BlockState state = built.stepper->state();
  BlockSystem::Part part(whole, {1, 2, 3}, {0, 0, 0, 1});
  const double before = whole.block(2).mass()(0, 0);
  state.position.rightCols(8) *= 2;  // of blocks 2 and 3, from their origins
  whole.reshape(state);
  part.read(whole, state);
  EXPECT_EQ(part.system().block(1).integration_weights(), whole.block(2).integration_weights());
  EXPECT_EQ(part.system().block(1).unknowns().first, 8);

  part.state().position.middleCols(4, 4) /= 2;
  part.system().reshape(part.state());
  part.write(whole, state);
  EXPECT_EQ(part.system().block(1).integration_weights(), whole.block(2).integration_weights());
  EXPECT_NEAR(whole.block(2).mass()(0, 0), before, 1e-9 * before);
  EXPECT_EQ(whole.block(2).unknowns().first, 16);
}
