#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/time/run_record.hpp>

using namespace support;

namespace {

constexpr double dt = 0.01;

/// Default mechanics: a fixed ground, and on it a stack of blocks of 1 m x 1 m.
Scene stack_scene(int n) {
  Scene scene;
  scene.analysis.time_step = dt;
  scene.analysis.steps = 200;
  scene.analysis.max_displacement_ratio = 1;
  scene.materials = {{"rock", 2500, 10e9, 0.2}};
  scene.joints = {{"joint", 35, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * 10e9;
  scene.contact.tangential_stiffness = 16 * 10e9;
  scene.blocks = {block(rectangle(-5, -1, 30, 1), true)};
  for (int k = 0; k < n; ++k) scene.blocks.push_back(block(rectangle(0, k, 1, 1)));
  for (BlockDescription& b : scene.blocks) b.model = BlockModel::wachspress;
  return scene;
}

Scene always_awake(Scene scene) {
  scene.analysis.skip.sleep = false;
  for (StageDescription& stage : scene.stages) stage.analysis.skip.sleep = false;
  return scene;
}

int n_asleep(const Stepper& stepper) {
  int n = 0;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) n += stepper.is_asleep(b);
  return n;
}

/// Positions differ by no more than `tolerance`, m.
void expect_same_places(const Stepper& one, const Stepper& other, double tolerance) {
  const Points difference = one.blocks().positions(one.state()) - other.blocks().positions(other.state());
  EXPECT_LE(difference.cwiseAbs().maxCoeff(), tolerance);
}

void expect_same_forces(const Stepper& one, const Stepper& other, double tolerance) {
  EXPECT_LE((one.reactions() - other.reactions()).cwiseAbs().maxCoeff(), tolerance);
  Vec2 sum = Vec2::Zero(), of_other = sum;
  for (const ContactRecord& contact : one.contacts()) sum += Vec2(contact.normal, contact.shear).cwiseAbs();
  for (const ContactRecord& contact : other.contacts())
    of_other += Vec2(contact.normal, contact.shear).cwiseAbs();
  EXPECT_LE((sum - of_other).norm(), 10 * tolerance);
}

void expect_closed_ledger(const Stepper& stepper) {
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-8);
}

/// Both steppers until `steps` are made.
void run_both(BuiltScene& one, BuiltScene& other, int steps) {
  run(*one.stepper, steps - static_cast<int>(one.stepper->counts().steps));
  run(*other.stepper, steps - static_cast<int>(other.stepper->counts().steps));
}

constexpr double weight = 2500 * 9.8;  // of a block of 1 m2

}  // namespace

TEST(Sleeping, AStackAtRestFallsAsleepAndStaysAsItIs) {
  const Scene scene = stack_scene(5);
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 200);
  const Stepper& stepper = *sleepy.stepper;
  EXPECT_EQ(n_asleep(stepper), 5);
  EXPECT_EQ(stepper.counts().asleep, 5);
  EXPECT_EQ(stepper.counts().equations, 0);
  EXPECT_EQ(n_asleep(*awake.stepper), 0);
  EXPECT_EQ(stepper.counts().steps, 200);
  EXPECT_NEAR(stepper.state().time, 200 * dt, 1e-12);
  EXPECT_EQ(stepper.state().velocity.norm(), 0);
  expect_same_places(stepper, *awake.stepper, 1e-8);
  expect_same_forces(stepper, *awake.stepper, 1e-5 * weight);
  EXPECT_NEAR(stepper.reactions().row(1).sum(), 35 * weight, 1e-6 * weight);
  EXPECT_EQ(stepper.counts().contacts, awake.stepper->counts().contacts);
  EXPECT_EQ(stepper.contacts().size(), awake.stepper->contacts().size());
  EXPECT_NEAR(stepper.energy().now.elastic, awake.stepper->energy().now.elastic,
              1e-6 * awake.stepper->energy().now.elastic);
  expect_closed_ledger(stepper);
}

TEST(Sleeping, OnlyInDynamicStepsOfTheDefaultMechanics) {
  Scene paper = stack_scene(2), classic = paper, statics = paper;
  paper.analysis.preset = Preset::paper;
  classic.contact.method = ContactMethod::classic;
  statics.analysis.mode = Mode::statics;
  for (const Scene& scene : {paper, classic, statics}) {
    BuiltScene built = build(scene);
    run(*built.stepper, 60);
    EXPECT_EQ(n_asleep(*built.stepper), 0);
  }
}

TEST(Sleeping, EquationsAreThoseOfTheBlockThatMoves) {
  Scene scene = stack_scene(3);
  for (int k = 0; k < 6; ++k)
    for (int level = 0; level < 2; ++level) scene.blocks.push_back(block(rectangle(2 + 2 * k, level, 1, 1)));
  scene.blocks.push_back(block(rectangle(1.2, 30, 0.5, 0.5)));
  const int mover = static_cast<int>(scene.blocks.size()) - 1;
  scene.blocks.back().velocity = Vec2(5, 5);
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 100);
  const Stepper& stepper = *sleepy.stepper;
  EXPECT_EQ(n_asleep(stepper), mover - 1);
  EXPECT_EQ(stepper.counts().equations, 8);
  EXPECT_EQ(awake.stepper->counts().equations, 8 * mover);
  EXPECT_EQ(stepper.blocks().n_equations(), 8 * mover);
  expect_same_places(stepper, *awake.stepper, 1e-8);
  expect_same_forces(stepper, *awake.stepper, 1e-4 * weight);
  const Vec2 v =
      rigid_velocity(stepper.blocks().block(mover), stepper.state(), stepper.state().velocity).linear;
  EXPECT_NEAR(v.y(), 5 - 9.8, 1e-9);
  expect_closed_ledger(stepper);
}

/// A block falls on a stack that sleeps by then: its island wakes, and all move as if it had never slept.
TEST(Sleeping, WhatIsHitWakesAndMovesAsIfItHadNot) {
  Scene scene = stack_scene(3);
  scene.blocks.push_back(block(rectangle(3, 0, 1, 1)));
  scene.blocks.push_back(block(rectangle(0.4, 8, 0.6, 0.6)));
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 95);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 4);
  run_both(sleepy, awake, 110);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 1) << "the stack is hit, the block beside it is not";
  EXPECT_TRUE(sleepy.stepper->is_asleep(4));
  expect_same_places(*sleepy.stepper, *awake.stepper, 1e-6);
  run_both(sleepy, awake, 400);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 5) << "and falls asleep again";
  expect_same_places(*sleepy.stepper, *awake.stepper, 1e-5);
  expect_closed_ledger(*sleepy.stepper);
}

TEST(Sleeping, LoadsThatChangeWake) {
  Scene scene = stack_scene(2);
  TimeFunction push{TimeFunction::Kind::history, {}, {}};
  push.history = {{0, 0, 0}, {1, 0, 0}, {1.1, 1.5 * weight, 0}, {1.3, 1.5 * weight, 0}, {1.4, 0, 0}};
  scene.loads = {point_load(2, Vec2(0.5, 1.5), push)};
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 99);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 2);
  run_both(sleepy, awake, 105);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 0);
  run_both(sleepy, awake, 200);
  EXPECT_GT(travel(*sleepy.stepper, 2).norm(), 0.01) << "pushed aside";
  expect_same_places(*sleepy.stepper, *awake.stepper, 1e-6);
  expect_closed_ledger(*sleepy.stepper);
}

TEST(Sleeping, BlocksOnSupportsThatMoveStayAwake) {
  Scene scene = stack_scene(1);
  scene.blocks[0].fixed = false;
  TimeFunction shake{TimeFunction::Kind::history, {}, {}};
  shake.history = {{0, 0, 0}, {1, 0, 0}, {1.2, 0.2, 0}, {1.4, 0.2, 0}};
  scene.supports = {{0, {0, 1, 2, 3}, true, true, shake}};
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  for (const int steps : {99, 105, 200}) {
    run_both(sleepy, awake, steps);
    EXPECT_EQ(n_asleep(*sleepy.stepper), 0);
  }
  expect_same_places(*sleepy.stepper, *awake.stepper, 1e-6);
  expect_closed_ledger(*sleepy.stepper);
}

TEST(Sleeping, SupportsThatComeNearWake) {
  Scene scene = stack_scene(1);
  scene.blocks.push_back(block(rectangle(-2, 0.2, 1, 0.5)));
  TimeFunction piston{TimeFunction::Kind::history, {}, {}};
  piston.history = {{0, 0, 0}, {2, 2, 0}};
  scene.supports = {{2, {0, 1, 2, 3}, true, true, piston}};
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 80);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 1);
  run_both(sleepy, awake, 190);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 0);
  EXPECT_GT(travel(*sleepy.stepper, 1).x(), 0.8);
  expect_same_places(*sleepy.stepper, *awake.stepper, 1e-5);
}

/// A meshed roof whose outline supports move comes down on a block that sleeps: its nodes there have no
/// unknowns.
TEST(Sleeping, ADrivenMeshPressesWhatSlept) {
  Scene scene = stack_scene(1);
  scene.blocks.push_back(block(rectangle(-1, 1 + 2e-5, 3, 0.5)));
  scene.blocks[2].model = BlockModel::mesh;
  scene.blocks[2].mesh.cells = 24;
  Support support;
  support.block = 2;
  support.vertices = {0, 1, 2, 3};
  support.displacement = {TimeFunction::Kind::history, {0, 0}, {{0, 0, 0}, {1, 0, 0}, {2, 0, -9e-5}}};
  scene.supports = {support};
  BuiltScene asleep = build(scene), awake = build(always_awake(scene));
  run_both(asleep, awake, 95);
  ASSERT_TRUE(asleep.stepper->is_asleep(1));
  run_both(asleep, awake, 300);
  expect_same_forces(*asleep.stepper, *awake.stepper, 1e-3 * weight);
  EXPECT_GT(asleep.stepper->reactions().row(1).maxCoeff(), 2 * weight) << "the roof presses";
}

/// A column that creeps under its weight, by damping with a relaxation time of a hundred steps, is slow and
/// not at rest.
TEST(Sleeping, WhatCreepsStaysAwake) {
  Scene scene = stack_scene(0);
  scene.materials[0].poisson = 0;
  scene.blocks.push_back(block(rectangle(0, 0, 1, 10)));
  scene.analysis.time_step = 10;
  scene.analysis.damping.stiffness = 1000;
  const BuiltScene built = build(scene);
  run(*built.stepper, 500);
  const double stress = built.stepper->blocks().block(1).stress(built.stepper->state())(1, 0);
  EXPECT_NEAR(stress, -5 * weight * (1 - std::exp(-5)), 1e-2 * 5 * weight);
}

TEST(Sleeping, AStageWakesAllSoThatWhatLosesItsRestFalls) {
  Scene scene = stack_scene(2);
  scene.blocks.push_back(block(rectangle(3, 0, 1, 1)));
  scene.stages = {scene.stage("rest"), scene.stage("removed")};
  scene.stages[0].analysis.steps = 100;
  scene.stages[1].analysis.steps = 30;
  scene.stages[1].removed = {1};
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 100);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 3);
  run_both(sleepy, awake, 130);
  EXPECT_FALSE(sleepy.stepper->is_asleep(2));
  EXPECT_TRUE(sleepy.stepper->is_asleep(3));
  EXPECT_NEAR(travel(*sleepy.stepper, 2).y(), -9.8 * 0.3 * 0.3 / 2, 1e-5);
  expect_same_places(*sleepy.stepper, *awake.stepper, 1e-8);
  expect_closed_ledger(*sleepy.stepper);
}

/// A stack on soft joints falls asleep under a block of another material that falls from high above: its
/// joints are rigid, and the first by number of those that are awake.
TEST(Sleeping, JointsKeepWhatTheirSpringsStore) {
  Scene scene = stack_scene(3);
  scene.materials.push_back({"hard", 2500, 10e9, 0.2});
  scene.joints[0].normal_stiffness = 0.1e9;
  scene.joints[0].shear_stiffness = 0.05e9;
  scene.joints.push_back({"rigid", 35, 0, 0, std::array{1, 1}});
  BlockDescription flier = block(rectangle(20, 80, 1, 1));
  flier.material = 1;
  scene.blocks.insert(scene.blocks.begin(), flier);
  scene.stages = {scene.stage("settles"), scene.stage("rests")};
  scene.stages[0].analysis.mode = Mode::statics;
  scene.stages[0].analysis.steps = 30;
  scene.stages[1].analysis.steps = 250;
  BuiltScene built = build(scene);
  run(*built.stepper, 280);
  EXPECT_EQ(n_asleep(*built.stepper), 3);
  double stored = 0;  // under 1, 2 and 3 blocks, by F^2 / (2 k l)
  for (int n : {1, 2, 3}) stored += std::pow(n * weight, 2) / (2 * 0.1e9);
  EXPECT_NEAR(built.stepper->energy().now.elastic, stored, 0.01 * stored);
  expect_closed_ledger(*built.stepper);
}

/// A block in flight at the top of its path, a slider just above the angle of friction and one that is pulled
/// along slowly are not at rest.
TEST(Sleeping, WhatIsSlowIsNotAtRest) {
  Scene scene = stack_scene(0);
  const double angle = radians(-35.0001);
  scene.blocks = {block(turned(rectangle(-2, -1, 20, 1), angle), true),
                  block(turned(rectangle(0, 0, 2, 1), angle))};
  BuiltScene built = build(scene);
  for (int k = 0; k < 200; ++k) {
    run(*built.stepper, 1);
    ASSERT_EQ(n_asleep(*built.stepper), 0) << k;
  }
  EXPECT_GT(travel(*built.stepper, 1).norm(), 1e-5);
}

/// An interruption after a try that woke blocks leaves the record as it was.
TEST(Sleeping, AnInterruptedRunIsTheSameToTheBit) {
  Scene scene = stack_scene(2);
  scene.blocks.push_back(block(rectangle(0.3, 6, 0.6, 0.6)));
  BuiltScene whole = build(scene), interrupted = build(scene);
  bool asked = false;
  interrupted.stepper->interrupt_when([&] { return asked; });
  bool stopped = false;
  for (int k = 0; k < 120; ++k) {
    const std::string before = to_bytes(interrupted.stepper->run_record());
    asked = true;
    const long substeps = interrupted.stepper->counts().substeps;
    if (!interrupted.stepper->step()) {
      stopped = true;
      if (interrupted.stepper->counts().substeps == substeps) {
        EXPECT_TRUE(to_bytes(interrupted.stepper->run_record()) == before) << k;
      }
      asked = false;
      run(*interrupted.stepper, 1);
    }
    run(*whole.stepper, 1);
    ASSERT_TRUE(to_bytes(whole.stepper->run_record()) == to_bytes(interrupted.stepper->run_record())) << k;
  }
  EXPECT_TRUE(stopped);
}

/// A support that has come to its end takes part in every step all the same: what rests on it keeps its
/// contacts, and its bond.
TEST(Sleeping, BlocksOnADrivenBaseKeepTheirContacts) {
  Scene scene = stack_scene(2);
  scene.joints = {{"joint", 35, 1e6, 1e6, std::nullopt}};
  scene.blocks[0].fixed = false;
  Support table{0, {0, 1, 2, 3}, true, true, {}};
  table.displacement = ddacontact::history_function(TimeFunction::Kind::history, {{0, 0, 0}, {0.3, 0, 0}});
  scene.supports = {table};
  const double weight = 2500 * 9.8;
  scene.loads = {point_load(2, Vec2(0.5, 2), {})};
  scene.loads[0].force =
      ddacontact::history_function(TimeFunction::Kind::history, {{1, 0, 0}, {1.2, 0, 2.5 * weight}});
  BuiltScene built = build(scene);
  run(*built.stepper, 99);
  EXPECT_EQ(built.stepper->counts().contacts, 4);
  EXPECT_NEAR(built.stepper->reactions().row(1).sum(), (30 + 2) * weight, 1);
  run(*built.stepper, 101);
  EXPECT_LT(std::abs(travel(*built.stepper, 1).y()), 1e-4);
  EXPECT_NEAR(built.stepper->reactions().row(1).sum(), (30 + 2 - 2.5) * weight, 1);
}

/// All vertices of a mesh are held; what vibrates inside is awake, and the reaction is not that of a moment.
TEST(Sleeping, MeshesThatVibrateInsideStayAwake) {
  Scene scene = stack_scene(1);
  scene.analysis.scheme = Scheme::midpoint;
  scene.analysis.time_step = 1e-4;
  scene.analysis.steps = 100;
  scene.blocks = {block(rectangle(0, 0, 5, 1))};
  scene.blocks[0].model = BlockModel::mesh;
  scene.blocks[0].mesh.cells = 16;
  scene.supports = {{0, {0, 1, 2, 3}, true, true, {}}};
  BuiltScene sleepy = build(scene), awake = build(always_awake(scene));
  run_both(sleepy, awake, 100);
  EXPECT_EQ(n_asleep(*sleepy.stepper), 0);
  EXPECT_GT(sleepy.stepper->energy().now.kinetic + sleepy.stepper->energy().now.elastic, 0.01);
  expect_same_forces(*sleepy.stepper, *awake.stepper, 1e-6);
}
