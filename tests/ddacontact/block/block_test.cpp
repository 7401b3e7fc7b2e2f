#include <tests/ddacontact/simple_scenes.hpp>
#include <tests/support/block_tangent.hpp>
#include <tests/support/concave_polygons.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

Points quadrilateral(const Vec2& at) {
  return points({{0, 0}, {3, 0.5}, {2.5, 2}, {-0.5, 1.5}}).colwise() + at;
}

BuiltScene one_polygon(const Vec2& at = {0, 0}, Scheme scheme = Scheme::dda) {
  Scene scene = rock_scene(0.1, 1);
  scene.analysis.scheme = scheme;
  if (scheme != Scheme::dda) scene.analysis.kinematics = Kinematics::corotational;
  scene.blocks = {block(quadrilateral(at))};
  return build(scene);
}

}  // namespace

TEST(Block, GridPointsAreTheNearestMultiplesOfAPowerOfTwoBelowItsSize) {
  const BuiltScene built = one_polygon();
  const Block& of = built.stepper->blocks().block(0);
  EXPECT_DOUBLE_EQ(of.size(), std::sqrt(polyfem::signed_area(quadrilateral({0, 0}))));
  const double grid = 2;  // the size is 2.1 m
  ASSERT_TRUE(of.size() >= grid && of.size() < 2 * grid);
  EXPECT_EQ(of.grid_point({0.9, -0.9}), Vec2(0, 0));
  EXPECT_EQ(of.grid_point({1.1, -1.1}), Vec2(grid, -grid));
  EXPECT_EQ(of.grid_point({1e6 + 0.3, -7.9}), Vec2(1e6, -8));
}

TEST(Block, ItsOriginFollowsItWhenItHasGoneFar) {
  const BuiltScene built = one_polygon({0, 0}, Scheme::decaying);
  const Block& of = built.stepper->blocks().block(0);
  BlockState state = built.stepper->state();
  for (const double by : {1., 1e3}) {
    state.position.row(1).array() -= by;
    const BlockState before = state;
    of.follow_with_origin(state);
    const Vec2 shift = state.origin.col(0) - before.origin.col(0);
    EXPECT_EQ(shift.norm() > 0, by > 8) << "four spacings";
    EXPECT_EQ(state.position.colwise() + shift, before.position);
    EXPECT_LE(state.position.rowwise().mean().cwiseAbs().maxCoeff(), 8);
    EXPECT_EQ(state.coordinates.head<2>(), before.coordinates.head<2>() - shift);
  }
}

TEST(Block, FurthestVertexOfARotationIsThatFarthestFromTheCentroid) {
  const BuiltScene built = one_polygon({5, 5});
  const Block& of = built.stepper->blocks().block(0);
  const BlockState& state = built.stepper->state();
  const double radius = (of.reference().colwise() - of.centroid(state)).colwise().norm().maxCoeff();
  EXPECT_NEAR(of.furthest_vertex(-2 * of.rigid_modes(state).col(2)), 2 * radius, 1e-13);
  EXPECT_NEAR(of.furthest_vertex(of.rigid_modes(state) * Vec3(3, 4, 0)), 5, 1e-13);
}

TEST(Block, EnergyOfAUniformStressIsThatOfItsStrain) {
  const BuiltScene built = one_polygon();
  const Block& of = built.stepper->blocks().block(0);
  BlockState state = built.stepper->state();
  const Vec3 strain(1e-4, -3e-4, 2e-4), stress = of.material().elasticity * strain;
  state.stress = stress.replicate(1, of.n_stress_points());
  EXPECT_NEAR(of.elastic_energy(state) / (of.reference_area() * stress.dot(strain) / 2), 1, 1e-13);
}

/// The parts of a tangent add up: a shift meets inertia alone.
TEST(Block, TangentOfAMeshMovesAsAWhole) {
  Scene scene = rock_scene(0.1, 1);
  scene.analysis.kinematics = Kinematics::corotational;
  scene.blocks = {block(quadrilateral({0, 0}))};
  scene.blocks[0].model = BlockModel::mesh;
  scene.blocks[0].mesh.cells = 12;
  BuiltScene built = build(scene);
  BlockSystem& blocks = blocks_of(built);
  const Block& of = blocks.block(0);
  StepRule rule;
  rule.scheme = Scheme::newmark;
  std::unique_ptr<BlockStep> step;
  of.begin_step(built.stepper->state(), step_start(built.stepper->state(), 0.1, rule), step);
  const MatrixXd K = tangent_of(of, *step, VectorXd::Zero(of.n_unknowns()));
  ASSERT_GT(of.n_parts(), 1);
  EXPECT_LE((K - K.transpose()).norm(), 1e-13 * K.norm());
  const MatrixXd inertia = rule.inertia() / 0.01 * of.mass() * of.translations();
  EXPECT_LE((K * of.translations() - inertia).norm(), 1e-12 * K.norm());
}

TEST(Block, APlaceIsTheWeightedSumOfItsVertices) {
  const BuiltScene built = one_polygon({1e3, 0});
  const Block& of = built.stepper->blocks().block(0);
  const Points corners = of.reference();
  for (const Vec2& x : {Vec2(corners.col(0)), Vec2(corners.leftCols(2).rowwise().mean()),
                        of.centroid(built.stepper->state())})
    EXPECT_LE((corners * of.point_weights(x) - x).norm(), 1e-12);
  EXPECT_LE((of.point_weights(corners.col(2)) - VectorXd::Unit(4, 2)).norm(), 1e-14);
  EXPECT_EQ(of.cell(0).corners, (std::vector<int>{0, 1, 2, 3}));
}

TEST(Block, UniformStrainIsAFieldWithoutRotationAboutTheCentroid) {
  const Vec3 strain(2, 3, 8);
  const Points w = uniform_strain_displacement(points({{1, 1}, {2, 1}, {1, 2}}), {1, 1}, strain);
  EXPECT_EQ(w, points({{0, 0}, {2, 4}, {4, 3}}));
}
