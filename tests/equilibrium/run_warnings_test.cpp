// What a run warns of, and what it does not.
#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/output/run_verdict.hpp>

#include <numbers>

using namespace support;

namespace {

Scene stone_scene(double young, double time_step, int steps, double friction_degrees) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"stone", 2500, young, 0.3}};
  scene.joints = {{"joint", friction_degrees, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * young;
  scene.contact.tangential_stiffness = 16 * young;
  return scene;
}

/// The paper's block on its slope of 45 degrees with friction 40, for .7 s under sudden gravity.
Scene sliding_scene(double young, double time_step) {
  Scene scene = stone_scene(young, time_step, static_cast<int>(std::lround(0.7 / time_step)), 40);
  const double angle = -radians(45);
  scene.blocks = {block(turned(rectangle(-2, -1, 17, 1), angle), true),
                  block(turned(rectangle(0, 0, 4, 2), angle))};
  scene.blocks[1].name = "slider";
  scene.blocks[1].model = BlockModel::wachspress;
  return scene;
}

std::vector<std::string> warnings_in(const Scene& scene) {
  return warnings_of(*run(scene).stepper);
}

double final_speed(const BuiltScene& built) {
  return rigid_velocity(built.stepper->blocks().block(1), built.stepper->state(),
                        built.stepper->state().velocity)
      .linear.norm();
}

/// One warning, with these words.
void expect_warning(const Scene& scene, const std::vector<const char*>& words) {
  const std::vector<std::string> warnings = warnings_in(scene);
  ASSERT_EQ(warnings.size(), 1u) << "E = " << scene.materials[0].young
                                 << ", dt = " << scene.analysis.time_step;
  for (const char* word : words)
    EXPECT_NE(warnings[0].find(word), std::string::npos) << word << " in " << warnings[0];
}

void expect_none(const Scene& scene) {
  for (const std::string& warning : warnings_in(scene)) ADD_FAILURE() << warning;
}

}  // namespace

/// What vibrates is too fast; the others are as fast as a rigid block.
TEST(RunWarnings, FrictionInducedVibrationIsTold) {
  expect_warning(sliding_scene(35e6, 0.002),
                 {"\"slider\" vibrates by friction", "changed their state in", "damping"});
  expect_warning(sliding_scene(35e6, 0.0005), {"\"slider\" vibrates by friction"});
  expect_warning(sliding_scene(350e6, 0.0005), {"\"slider\" vibrates by friction"});
  expect_none(sliding_scene(35e6, 0.02));
  expect_none(sliding_scene(350e6, 0.002));  // it hardly vibrates
  const double stiff = final_speed(run(sliding_scene(35e9, 0.002)));
  EXPECT_NEAR(final_speed(run(sliding_scene(350e6, 0.002))), stiff, 0.02 * stiff);
  expect_none(sliding_scene(35e9, 0.002));
  expect_none(sliding_scene(35e9, 0.0005));
}

/// With the damping that the warning names, less than half of the error is left.
TEST(RunWarnings, FrictionInducedVibrationIsCuredAsTold) {
  Scene scene = sliding_scene(35e6, 0.002);
  const BuiltScene undamped = run(scene);
  const std::string text = warnings_of(*undamped.stepper).at(0);
  const std::string key = "damping = { stiffness = ";
  scene.analysis.damping.stiffness = std::stod(text.substr(text.find(key) + key.size()));
  expect_none(scene);
  const BuiltScene built = run(scene);
  const double exact = 9.8 * 0.7 * (std::sin(radians(45)) - std::cos(radians(45)) * std::tan(radians(40)));
  EXPECT_LT(std::abs(final_speed(built) - exact), std::abs(final_speed(undamped) - exact) / 2);
}

/// 100 steps a turn, two turns.
TEST(RunWarnings, EnergyThatRisesIsTold) {
  Scene scene = stone_scene(100e9, 0.01, 200, 30);
  scene.analysis.gravity = Vec2(0, 0);
  scene.analysis.scheme = Scheme::newmark;
  scene.blocks = {block(rectangle(-9, -1, 1, 1), true), block(rectangle(0, 0, 2, 1))};
  scene.blocks[1].angular_velocity = 2 * std::numbers::pi;
  for (const double gamma : {0.5, 0.6}) {
    scene.analysis.gamma = gamma;
    scene.analysis.beta = (gamma + 0.5) * (gamma + 0.5) / 4;
    if (gamma < 0.6)
      expect_warning(scene, {"energy rose by", "gamma of 0.6"});
    else
      expect_none(scene);
  }
  scene.analysis.scheme = Scheme::decaying;
  expect_none(scene);
}

TEST(RunWarnings, WorkOfLoadsAndSupportsIsNoRise) {
  Scene scene = stone_scene(35e9, 0.01, 100, 30);
  scene.analysis.gravity = Vec2(0, 0);
  scene.blocks = {block(rectangle(-9, -1, 1, 1), true), block(rectangle(0, 0, 2, 1)),
                  block(rectangle(0, 5, 2, 1))};
  scene.loads = {point_load(1, Vec2(1, 0.5), constant(Vec2(1e5, 0)))};
  scene.supports = {{2, {0, 1, 2, 3}, true, true, {TimeFunction::Kind::rate, Vec2(1, 0), {}}}};
  expect_none(scene);
}

TEST(RunWarnings, LongWaysInContactAreToldAndFlightIsNot) {
  Scene scene = stone_scene(35e9, 0.01, 20, 0);
  scene.blocks = {block(rectangle(-5, -1, 60, 1), true), block(rectangle(0, 0, 2, 1))};
  scene.blocks[1].velocity = Vec2(25, 0);
  expect_warning(scene, {"20 of 20 substeps", "first at 0.01 s", "furthest block \"1\", by 0.18 of its size",
                         "(a smaller 'time_step')"});
  scene.blocks[1].vertices = rectangle(0, 3, 2, 1);
  expect_none(scene);
}

/// Five blocks on a table that is shaken to and fro with a period of two steps.
TEST(RunWarnings, ContactsThatChangeInMostStepsAreTold) {
  Scene scene = stone_scene(35e9, 0.01, 40, 30);
  scene.blocks = {block(rectangle(-5, -1, 30, 1))};
  for (int k = 0; k < 5; ++k) scene.blocks.push_back(block(rectangle(3 * k, 0, 1, 1)));
  Support table{0, {0, 1, 2, 3}, true, true, {TimeFunction::Kind::history, Vec2(0, 0), {}}};
  for (int k = 0; k <= 40; ++k)
    table.displacement.history.push_back(Vec3(0.01 * k, k % 2 == 0 ? 0 : 0.005, 0));
  scene.supports = {table};
  expect_warning(
      scene, {"contacts of most blocks changed their state in", "of 40 substeps", "(a smaller 'time_step')"});
  for (Vec3& entry : scene.supports[0].displacement.history) entry[1] = 0;
  expect_none(scene);
}

/// A block of four cells on a floor: two corners press. Where `auto` has chosen the mesh nothing is said.
TEST(RunWarnings, PatchesOfFewNodesAreToldToWhoAsksForAMesh) {
  Scene scene = stone_scene(35e9, 0.1, 3, 30);
  scene.analysis.mode = Mode::statics;
  scene.blocks = {block(rectangle(-5, -1, 10, 1), true), block(rectangle(0, 0, 1, 1))};
  scene.blocks[1].model = BlockModel::mesh;
  scene.blocks[1].mesh.kind = CellKind::voronoi;
  scene.blocks[1].mesh.edge_nodes = false;
  scene.blocks[1].mesh.cells = 4;
  expect_warning(scene, {"fewer than four nodes: 1", "at_contact"});
  EXPECT_TRUE(warnings_of(*run(scene).stepper, {"held", "bends"}).empty());
  scene.blocks[1].mesh = {.cells = 64};
  expect_none(scene);
}

namespace {

constexpr int n_bricks = 3;

/// A brick that comes with 1 m/s and no friction over a row of free bricks between fixed ends, for .6 s: it
/// has to pass two joints.
Scene brick_on_a_row(double young, double rounding, double step_drawn = 0) {
  Scene scene = stone_scene(young, 0.01, 60, 0);
  scene.contact.corner_rounding = rounding;
  scene.blocks = {block(rectangle(-1, -1, n_bricks + 2, 1), true), block(rectangle(-1, 0, 1, 1), true),
                  block(rectangle(n_bricks, 0, 1, 1), true)};
  for (int k = 0; k < n_bricks; ++k)
    scene.blocks.push_back(block(rectangle(k, 0, 1, k < 2 ? 1 : 1 + step_drawn)));
  scene.blocks.push_back(block(rectangle(0.6, 1, 1, 1)));
  scene.blocks.back().name = "comes";
  scene.blocks.back().velocity = Vec2(1, 0);
  return scene;
}

double way(const Scene& scene) {
  const BuiltScene built = run(scene);
  const BlockSystem& blocks = built.stepper->blocks();
  return blocks.displacements(built.stepper->state())(0,
                                                      blocks.block(blocks.n_blocks() - 1).vertices().first);
}

}  // namespace

/// Bricks of 35 GPa sink by less than the lip under their own weight, those of 20 MPa by more.
TEST(RunWarnings, AStepThatCompressionMakesInAFlushJointIsToldWhereItHoldsACorner) {
  EXPECT_NEAR(way(brick_on_a_row(35e9, 0)), 0.6, 1e-3);
  expect_none(brick_on_a_row(35e9, 0));
  EXPECT_LT(way(brick_on_a_row(20e6, 0)), 0.55);
  const std::vector<std::string> warnings = warnings_in(brick_on_a_row(20e6, 0));
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& told) {
    return told.find("caught on a small step") != told.npos && told.find("of block \"comes\"") != told.npos &&
           told.find("corner_rounding") != told.npos;
  }));
  EXPECT_NEAR(way(brick_on_a_row(20e6, 0.003)), 0.6, 1e-3);
  expect_none(brick_on_a_row(20e6, 0.003));
}

/// Its step holds the brick as it has to.
TEST(RunWarnings, AStepThatIsDrawnIsNotTold) {
  EXPECT_LT(way(brick_on_a_row(35e9, 0, 2e-3)), 0.45);
  expect_none(brick_on_a_row(35e9, 0, 2e-3));
}

/// A slab of 10 x 0.2 m pressed along: pinned at both ends it would buckle under pi^2 / 12 (0.2/10)^2 E.
TEST(RunWarnings, SlenderBlocksNearBucklingAreTold) {
  const auto pressed = [](double of_critical, BlockModel model, Scheme scheme) {
    Scene scene = stone_scene(20e9, 0.05, 10, 45);
    scene.materials[0].poisson = 0;
    scene.analysis.mode = Mode::statics;
    scene.analysis.scheme = scheme;
    scene.analysis.gravity = Vec2::Zero();
    scene.blocks = {block(rectangle(0, 0, 10, 0.2))};
    scene.blocks[0].name = "slab";
    scene.blocks[0].model = model;
    scene.blocks[0].fixed_vertices = {0, 3};
    const double pressure = of_critical * std::numbers::pi * std::numbers::pi / 12 * 0.02 * 0.02 * 20e9;
    Load load;
    load.kind = Load::Kind::pressure;
    load.edge = 1;
    load.force = {TimeFunction::Kind::constant, {pressure, 0}, {}};
    scene.loads = {load};
    return scene;
  };
  for (const BlockModel model : {BlockModel::affine, BlockModel::mean_value, BlockModel::mesh}) {
    expect_warning(pressed(0.2, model, Scheme::decaying), {"\"slab\" bears a thrust of 0.2 of Euler's load"});
    expect_none(pressed(0.05, model, Scheme::decaying));
  }
  expect_warning(pressed(0.2, BlockModel::affine, Scheme::backward_euler), {"thrust of 0.2"});
  expect_none(pressed(0.2, BlockModel::mesh, Scheme::backward_euler));
}
