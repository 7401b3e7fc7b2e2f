#include <ddacontact/scene/reader.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

Vec2 contact_forces_on(const Stepper& stepper, int b) {
  Vec2 sum = Vec2::Zero();
  const BlockState& state = stepper.state();
  for (const ContactRecord& c : stepper.contacts()) {
    const Range& v = stepper.blocks().block(c.pair.edge_block).vertices();
    const Vec2 along = (state.position.col(v.first + (c.pair.edge + 1) % v.count) -
                        state.position.col(v.first + c.pair.edge))
                           .normalized();
    const Vec2 force = c.normal * Vec2(along.y(), -along.x()) + c.shear * along;
    if (c.pair.vertex_block == b) sum += force;
    if (c.pair.edge_block == b) sum -= force;
  }
  return sum;
}

/// A block on a fixed one, tilted by `angle` together with the fixed block; gravity stays.
Scene resting(BlockModel model, double angle, Mode mode) {
  Scene scene = rock_scene(0.01, 100);
  scene.analysis.mode = mode;
  scene.joints[0].friction_angle = 40;
  scene.blocks = {block(turned(rectangle(-2, -1, 6, 1), angle), true),
                  block(turned(rectangle(0, 0, 2, 1), angle))};
  scene.blocks[0].model = scene.blocks[1].model = model;
  return scene;
}

constexpr double weight_above = 2 * 2000 * 10;

}  // namespace

/// Forces are inside the cone at the end of every step, also while the block rocks and slides.
TEST(Rest, ContactForcesStayInsideTheCone) {
  Scene scene = resting(BlockModel::wachspress, radians(40.5), Mode::dynamic);
  const BuiltScene built = build(scene);
  const double mu = std::tan(radians(40));
  for (int k = 0; k < 60; ++k) {
    run(*built.stepper, 1);
    for (const ContactRecord& c : built.stepper->contacts()) {
      if (!c.closed() || c.history.bonded) continue;
      EXPECT_GE(c.normal, -1e-6 * weight_above);
      EXPECT_LE(std::abs(c.shear), mu * c.normal + 1e-8 * weight_above);
    }
  }
}

/// The toe of a block that topples, in a notch where the gaps of two contacts cannot both be closed: static
/// steps that go on correcting them would add to both forces for ever.
TEST(Rest, ForcesInANotchDoNotGrowStepByStep) {
  Scene scene;
  scene.analysis.mode = Mode::statics;
  scene.analysis.gravity = Vec2(0, -10);
  scene.analysis.time_step = 1e-3;
  scene.analysis.steps = 400;
  scene.analysis.block_model = BlockModel::affine;
  scene.materials = {{"rock", 2000, 5e9, 0.2}};
  scene.joints = {{"joint", 35, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = scene.contact.tangential_stiffness = 2e11;
  Points toppling(2, 3);
  toppling << 0, 0, -1,  //
      0, 2, 2;
  scene.blocks = {block(rectangle(0, -1, 1, 4), true), block(rectangle(-1, -1, 1, 1), true), block(toppling)};
  const double weight = 2000 * 10;
  const BuiltScene built = run(scene);
  double largest = 0;
  for (const ContactRecord& contact : built.stepper->contacts())
    largest = std::max(largest, std::abs(contact.normal));
  EXPECT_LE(largest, 5 * weight);
}

/// Of bricks of 1 x 0.5 m, every second course beginning and ending with half a brick, on a slab; it does not
/// sleep.
Scene wall_in_running_bond(int n_courses, int n_bricks) {
  Scene scene;
  scene.analysis.gravity = Vec2(0, -10);
  scene.analysis.time_step = 0.01;
  scene.analysis.steps = 1;
  scene.analysis.skip.sleep = false;
  scene.materials = {{"rock", 2000, 1e10, 0.25}};
  scene.joints = {{"joint", 35, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = scene.contact.tangential_stiffness = 4e11;
  scene.blocks = {block(rectangle(-1, -1, n_bricks + 2, 1), true)};
  for (int course = 0; course < n_courses; ++course) {
    const double y = 0.5 * course;
    const bool shifted = course % 2 == 1;
    if (shifted) scene.blocks.push_back(block(rectangle(0, y, 0.5, 0.5)));
    for (int k = 0; k < n_bricks - (shifted ? 1 : 0); ++k)
      scene.blocks.push_back(block(rectangle(k + (shifted ? 0.5 : 0.0), y, 1, 0.5)));
    if (shifted) scene.blocks.push_back(block(rectangle(n_bricks - 0.5, y, 0.5, 0.5)));
  }
  return scene;
}

/// Gaps of running bond are connected: forces that correct one open another. Small gaps stay uncorrected, so
/// the wall comes to rest, and its blocks carry what stands on them nonetheless.
TEST(Rest, AWallInRunningBondComesToRest) {
  constexpr int n_courses = 12, n_bricks = 12;
  const BuiltScene built = build(wall_in_running_bond(n_courses, n_bricks));
  Stepper& stepper = *built.stepper;
  run(stepper, 300);
  const StepCounts before = stepper.counts();
  const Points point = stepper.state().position;
  run(stepper, 20);
  // Two a step and some that bring residuals to 1e-12 of the forces.
  EXPECT_LE(stepper.counts().contact_iterations - before.contact_iterations, 2.5 * 20);
  EXPECT_EQ(stepper.counts().rejected, before.rejected);
  EXPECT_LE((stepper.state().position - point).cwiseAbs().maxCoeff(), 1e-10);
  const double weight = 2000 * 10 * 0.5 * n_courses * n_bricks;
  EXPECT_NEAR(stepper.reactions().row(1).sum(), weight + 2000 * 10 * (n_bricks + 2), 1e-8 * weight);
}

/// Static steps take gaps back whole: joints slip ever less by what gaps add to forces.
TEST(Rest, AStaticWallOfManyCoursesSlipsEverLess) {
  Scene scene = wall_in_running_bond(32, 32);
  scene.analysis.mode = Mode::statics;
  scene.analysis.time_step = 0.03;
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  run(stepper, 40);
  const double dissipated = stepper.energy().now.friction_dissipated;
  EXPECT_GT(dissipated, 0.1);
  run(stepper, 5);
  EXPECT_LE(stepper.energy().now.friction_dissipated, dissipated * (1 + 2e-3));
  EXPECT_TRUE(stepper.equilibrium().in_balance());
}

/// A wall of rectangles and two blocks of six corners under 0.31 of its weight sideways, three quarters of what
/// overturns it: its corners are asked before the stage ends, and it rests again when it does.
TEST(Rest, AStageEndsInItThoughItsCornersWereAsked) {
  constexpr const char* wall = R"(
format = 1
parameters = { x1 = 0.341403178, x2 = 0.682806356, x3 = 1.024209534, y1 = 0.367777635, y2 = 0.735555270, y3 = 1.103332904, y4 = 1.471110539 }
analysis = { mode = "static", steps = 25, time_step = 0.01, gravity = [3.09429, -10] }
material = [{ name = "rock", density = 2000, young = 5e9, poisson = 0.2 }]
joint = [{ name = "dry", friction_angle = 25.850395 }]
[[block]]
material = 0
vertices = [[-5, -1], [9, -1], [9, 0], [-5, 0]]
fixed = true
[[block]]
material = 0
vertices = [[0, 0], ["$x1", 0], ["$x1", "$y3"], [0, "$y3"]]
[[block]]
material = 0
vertices = [["$x1", "$y1"], ["$x3", "$y1"], ["$x3", "$y2"], ["$x2", "$y2"], ["$x2", "$y3"], ["$x1", "$y3"]]
[[block]]
material = 0
vertices = [["$x3", "$y4"], ["$x1", "$y4"], ["$x1", "$y3"], ["$x2", "$y3"], ["$x2", "$y2"], ["$x3", "$y2"]]
[[block]]
material = 0
vertices = [["$x1", 0], ["$x3", 0], ["$x3", "$y1"], ["$x1", "$y1"]]
[[block]]
material = 0
vertices = [[0, "$y3"], ["$x1", "$y3"], ["$x1", "$y4"], [0, "$y4"]]
)";
  for (const char* steps : {"25", "26", "30", "40", "60"}) {
    const SceneReading reading =
        ddacontact::read_scene_text(wall, "wall.toml", {std::string("analysis.steps=") + steps});
    ASSERT_TRUE(reading.scene) << reading.problems.front().text();
    EXPECT_TRUE(run(*reading.scene).stepper->is_at_rest()) << steps;
  }
}

/// An overlap at the start is free of stress: the block neither jumps nor sinks by it. All points and the
/// lock points' fractions are whole binary numbers: nothing is left to round-off.
TEST(Rest, AnInitialOverlapMakesNoForce) {
  Scene scene = resting(BlockModel::wachspress, 0, Mode::dynamic);
  scene.analysis.gravity.setZero();
  scene.blocks[0].vertices = rectangle(-2, -1, 8, 1);
  scene.blocks[1].vertices.row(1).array() -= 1. / 1024;
  const BuiltScene built = run(scene);
  EXPECT_LE(travel(*built.stepper, 1).norm(), 1e-12);
  EXPECT_LE(contact_forces_on(*built.stepper, 1).norm(), 1e-6);
  EXPECT_EQ(built.stepper->energy().now.elastic, 0);
}

/// The same by the staged method, which opens a contact that bears nothing: blocks that are not pressed
/// together keep their overlap, and one that is drawn away is not pushed.
TEST(Rest, AnInitialOverlapStaysFreeOfStressWhileItsContactIsOpen) {
  for (const Mode mode : {Mode::dynamic, Mode::statics})
    for (const double up : {0., 0.01}) {
      Scene scene = default_mechanics(resting(BlockModel::wachspress, 0, mode));
      scene.analysis.gravity.setZero();
      scene.blocks[0].vertices = rectangle(-2, -1, 8, 1);
      scene.blocks[1].vertices.row(1).array() -= 1. / 1024;
      scene.blocks[1].velocity = {0, up};
      const BuiltScene built = run(scene);
      const double far = mode == Mode::dynamic ? up * scene.end_time() : 0;
      EXPECT_NEAR(travel(*built.stepper, 1).y(), far, 1e-12);
      const Energy& energy = built.stepper->energy().now;
      EXPECT_LE(energy.kinetic + energy.elastic, 2 * 2000 * up * up / 2 * (1 + 1e-9));
    }
}

/// A vertex that a support holds upright stands on the corner of a fixed block: what both bear cannot be told
/// apart, and the support bears it.
TEST(Rest, AFixedVertexOnACornerLeavesItsForceToTheSupport) {
  for (const Mode mode : {Mode::statics, Mode::dynamic})
    for (const BlockModel model : {BlockModel::affine, BlockModel::mean_value}) {
      Scene scene;
      scene.analysis.time_step = 0.01;
      scene.analysis.steps = 100;
      scene.analysis.mode = mode;
      scene.analysis.gravity = Vec2(0, -9.8);
      scene.analysis.scheme = Scheme::decaying;
      scene.materials = {{"rock", 2500, 5e9, 0.2}};
      scene.joints = {{"joint", 30, 0, 0, std::nullopt}};
      scene.contact.normal_stiffness = 2e11;
      scene.contact.tangential_stiffness = 8e10;
      scene.blocks = {block(rectangle(0, -1, 1, 1), true), block(rectangle(0, 0, 1, 1))};
      scene.blocks[1].model = model;
      scene.supports = {{1, {0}, false, true, {}}};
      const BuiltScene built = run(scene);
      double normal = 0;
      for (const ContactRecord& contact : built.stepper->contacts()) normal += contact.normal;
      EXPECT_NEAR(normal, 12250, 1) << static_cast<int>(mode) << static_cast<int>(model);
      EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-9);
    }
}
