#include <ddacontact/block/block_system.hpp>

#include <ddacontact/classic/affine_block.hpp>
#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A quadrilateral, a six-unknown block and a triangle, apart.
Scene three_blocks() {
  Scene scene = rock_scene(0.1, 10);
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(3, 0, 1, 1)), block(Points(2, 3))};
  scene.blocks[1].model = BlockModel::affine;
  scene.blocks[2].vertices << 6, 7, 6, 0, 0, 1;
  return scene;
}

}  // namespace

TEST(BlockSystem, NumbersUnknownsVerticesAndStressPointsInBlockOrderWithoutHoles) {
  const BuiltScene built = build(three_blocks());
  const BlockSystem& system = built.stepper->blocks();
  int unknown = 0, vertex = 0, point = 0;
  for (int b = 0; b < 3; ++b) {
    const Block& of = system.block(b);
    EXPECT_EQ(of.unknowns().first, unknown);
    EXPECT_EQ(of.vertices().first, vertex);
    EXPECT_EQ(of.stress_points().first, point);
    EXPECT_EQ(of.unknowns().count, of.n_unknowns());
    unknown = of.unknowns().end();
    vertex = of.vertices().end();
    point = of.stress_points().end();
  }
  EXPECT_EQ(system.n_unknowns(), unknown);
  EXPECT_EQ(unknown, 8 + 6 + 6);
  EXPECT_EQ(system.n_stress_points(), point);
  EXPECT_EQ(built.stepper->state().position.cols(), vertex);
  EXPECT_EQ(system.n_equations(), unknown);
}

TEST(BlockSystem, PrescribedDofsAreLeftOutOfTheEquationsAndTheOthersKeepTheirOrder) {
  Scene scene = three_blocks();
  scene.blocks[0].fixed_vertices = {1};
  scene.supports = {{1, {0}, true, false, {}}};
  scene.blocks[2].fixed = true;
  const BuiltScene built = build(scene);
  const BlockSystem& system = built.stepper->blocks();
  EXPECT_EQ(system.n_equations(), 6 + 5 + 0);
  int next = 0;
  for (int e : system.equation()) {
    if (e < 0) continue;
    EXPECT_EQ(e, next++);
  }
  EXPECT_EQ(next, system.n_equations());
  EXPECT_EQ(system.equation()[2], -1);
  EXPECT_EQ(system.equation()[3], -1);
  EXPECT_TRUE(system.is_movable(0) && system.is_movable(1));
  EXPECT_FALSE(system.is_movable(2));
  EXPECT_TRUE(system.is_unchanging(2));
  EXPECT_FALSE(system.is_unchanging(0) || system.is_unchanging(1));
}

TEST(BlockSystem, AHeldBlockThatIsMovedChangesButIsNotMovable) {
  Scene scene = three_blocks();
  scene.supports = {{2, {0, 1, 2}, true, true, {TimeFunction::Kind::rate, {1, 0}, {}}}};
  const BuiltScene built = build(scene);
  EXPECT_FALSE(built.stepper->blocks().is_movable(2));
  EXPECT_FALSE(built.stepper->blocks().is_unchanging(2));
}

TEST(BlockSystem, PrescribedMotionLeadsFromWhereAPointIsToWhereItShouldBe) {
  using Kind = TimeFunction::Kind;
  const std::vector<Vec3> history{{0, 0, 0}, {0.5, 1, 2}, {1, 0, 4}};
  for (const TimeFunction& motion :
       {TimeFunction{Kind::ramp, {2, -1}, {}}, TimeFunction{Kind::rate, {2, -1}, {}},
        TimeFunction{Kind::history, {0, 0}, history}, TimeFunction{Kind::constant, {0.5, 0}, {}}}) {
    Scene scene = three_blocks();
    scene.supports = {{0, {2}, true, true, motion}, {1, {3}, true, true, motion}};
    const BuiltScene built = build(scene);
    const BlockSystem& system = built.stepper->blocks();
    BlockState state = built.stepper->state();
    state.position.array() += 0.125;
    const VectorXd d = system.prescribed(state, 0.75);
    const Vec2 expected = motion.at(0.75, 1) - Vec2(0.125, 0.125);
    for (auto [b, v] : {std::pair(0, 2), std::pair(1, 3)})
      EXPECT_LE((system.block(b).vertex_map(v)(d) - expected).norm(), 1e-15);
    EXPECT_EQ((d.array() != 0).count(), 2 * (expected.x() != 0) + 2 * (expected.y() != 0));
  }
}

/// What an affine block cannot follow is refused, what it can is not.
TEST(BlockSystem, SupportsThatAnAffineBlockCannotFollowAreRefused) {
  Scene scene = three_blocks();
  const TimeFunction shift{TimeFunction::Kind::ramp, {0.1, 0}, {}};
  scene.supports = {{1, {0, 1, 2, 3}, true, true, shift}};
  EXPECT_NO_THROW(build(scene));
  scene.supports = {{1, {0, 1, 2}, true, true, shift}, {1, {3}, true, true, {}}};
  EXPECT_THROW(build(scene), Error);
}

TEST(BlockSystem, GravityIsTheWeightInTheCentroid) {
  const BuiltScene built = build(three_blocks());
  const BlockSystem& system = built.stepper->blocks();
  VectorXd F = VectorXd::Zero(system.n_unknowns());
  system.add_gravity(F);
  for (int b = 0; b < 3; ++b) {
    const Block& of = system.block(b);
    const Vec3 resultant =
        of.rigid_modes(built.stepper->state()).transpose() * F.segment(of.unknowns().first, of.n_unknowns());
    EXPECT_LE((resultant - Vec3(0, -10 * of.mass_total(), 0)).norm(), 1e-9);
  }
}

TEST(BestFitRotation, IsTheAngleOfARotatedAndInflatedOutline) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 200; ++trial) {
    const Points outline = random_convex_polygon(3 + trial % 6, random).colwise() + Vec2(3, -8);
    const double angle = uniform(-3.14, 3.14, random);
    const Points moved = (uniform(0.5, 2, random) * turned(outline, angle)).colwise() + Vec2(-1, 6);
    EXPECT_NEAR(best_fit_rotation(outline, moved), angle, 1e-12);
  }
}

/// Of all rotations of the reference it leaves the least squares of distances.
TEST(BestFitRotation, FitsADeformedOutlineBest) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Points outline = random_convex_polygon(5, random);
    const Points moved = turned(outline, uniform(-3, 3, random)) + 0.1 * Points::Random(2, 5);
    const double angle = best_fit_rotation(outline, moved);
    const auto misfit = [&](double a) {
      const Points q = moved.colwise() - Vec2(moved.rowwise().mean());
      return (turned(outline.colwise() - Vec2(outline.rowwise().mean()), a) - q).squaredNorm();
    };
    for (double away : {-1., -1e-3, 1e-3, 1., 3.}) EXPECT_LT(misfit(angle), misfit(angle + away));
  }
}

/// An edge of a tenth of a millimetre leaves no room for arcs of a radius of 0.3 % but on its own block.
TEST(BlockSystem, ArcsOfABlockWithAShortEdgeAreSmallerThanOfOthers) {
  Scene scene = rock_scene(0.1, 1);
  Points cut(2, 5);
  cut << 3, 4, 4, 4 - 1e-4, 3,  //
      0, 0, 1 - 1e-4, 1, 1;
  scene.blocks = {block(rectangle(0, 0, 1, 1)), block(cut)};
  BuiltScene built = build(scene);
  BlockSystem& system = blocks_of(built);
  system.round_corners(0.003);
  EXPECT_DOUBLE_EQ(system.rounded(0).radius, 0.003);
  EXPECT_DOUBLE_EQ(system.rounded(1).radius, largest_rounding(system.block(1).reference()).radius / 2);
  EXPECT_LT(system.rounded(1).radius, 2e-4);
}
