#include <tests/ddacontact/time/staged_scenes.hpp>

#include <ddacontact/time/run_record.hpp>

using namespace support;

TEST(Stages, SettleThenSlideFromRestAsFromTheStart) {
  Scene scene = slope_scene(30, 20);
  StageDescription slide = scene.stage("slide");
  slide.analysis.steps = 60;
  scene.stages = {settling(scene, 5), slide};
  EXPECT_EQ(scene.n_steps(), 65);
  EXPECT_DOUBLE_EQ(scene.end_time(), 0.65);
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  run(stepper, 5);
  EXPECT_EQ(stepper.stage(), 0);
  EXPECT_EQ(stepper.state().velocity.norm(), 0) << "a static stage ends at rest";
  EXPECT_EQ(stepper.blocks().displacements(stepper.state()).norm(), 0) << "reset at the end of the stage";
  const double settled = stepper.blocks().block(1).centroid(stepper.state()).norm();
  run(stepper, 60);
  EXPECT_EQ(stepper.stage(), 1);
  EXPECT_DOUBLE_EQ(stepper.state().time, 0.65);
  const double t = 0.6, a = 9.8 * (std::sin(radians(30)) - std::tan(radians(20)) * std::cos(radians(30)));
  const Points moved = stepper.blocks().displacements(stepper.state());
  for (Index v = 4; v < 8; ++v) EXPECT_NEAR(moved.col(v).norm(), a * t * t / 2, 1e-5 * a * t * t / 2);
  EXPECT_GT(settled, 0);
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-8);  // what residuals of that leave
}

TEST(Stages, OnesThatChangeNothingChangeNoBit) {
  Scene whole = slope_scene(30, 20);
  whole.analysis.time_step = 1.0 / 128;  // times add up without round-off
  Scene parts = whole;
  for (int steps : {7, 1, 42}) {
    parts.stages.push_back(whole.stage(""));
    parts.stages.back().analysis.steps = steps;
  }
  BuiltScene one = build(whole), many = build(parts);
  run(*one.stepper, 50);
  run(*many.stepper, 50);
  EXPECT_EQ(one.stepper->state().position, many.stepper->state().position);
  EXPECT_EQ(one.stepper->state().velocity, many.stepper->state().velocity);
  EXPECT_EQ(one.stepper->energy().now.total(), many.stepper->energy().now.total());
  EXPECT_EQ(one.stepper->counts().linear_solves, many.stepper->counts().linear_solves);
}

TEST(Stages, ABlockThatIsTakenOutLeavesNothing) {
  Scene scene = beam_scene();
  scene.loads = {point_load(2, Vec2(4.5, 0.5), constant(Vec2(0, -1e5)))};
  scene.stages = {settling(scene, 10), scene.stage("released")};
  scene.stages[1].analysis.steps = 40;
  scene.stages[1].removed = {2};
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  run(stepper, 10);
  EXPECT_TRUE(stepper.blocks().is_present(2)) << "to the end of the stage before";
  const double elastic = stepper.energy().now.elastic;
  run(stepper, 1);
  EXPECT_FALSE(stepper.blocks().is_present(2));
  EXPECT_EQ(stepper.blocks().n_present(), 3);
  EXPECT_LT(stepper.energy().now.external, 0) << "its energy went with it";
  EXPECT_GT(stepper.energy().now.external, -elastic);
  run(stepper, 39);
  for (const ContactRecord& contact : stepper.contacts()) {
    EXPECT_NE(contact.pair.vertex_block, 2);
    EXPECT_NE(contact.pair.edge_block, 2);
  }
  // The beam turns about the pillar that is left, as a rigid one would: by less than it falls freely.
  const Vec2 end =
      stepper.blocks().displacements(stepper.state()).col(stepper.blocks().block(3).vertices().first + 1);
  EXPECT_LT(end.y(), -0.05);
  EXPECT_GT(end.y(), -9.8 * 0.2 * 0.2);
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-6);
}

TEST(Stages, AStaticStageTakesTheVelocitiesOut) {
  Scene scene = slope_scene(0, 30);
  scene.blocks[1].velocity = Vec2(3, 0);
  StageDescription still = scene.stage("still");
  still.analysis.mode = Mode::statics;
  still.analysis.steps = 3;
  scene.stages = {scene.stage("moving"), still};
  scene.stages[0].analysis.steps = 5;
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  run(stepper, 5);
  const Energy before = stepper.energy().now;
  EXPECT_GT(before.kinetic, 1000);
  run(stepper, 3);
  EXPECT_EQ(stepper.energy().now.kinetic, 0);
  EXPECT_GE(stepper.energy().now.numerical_dissipated,
            before.numerical_dissipated + before.kinetic * (1 - 1e-9));
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-9);
}

TEST(Stages, EverySchemeSettlesInStaticSteps) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::central_difference, Scheme::midpoint, Scheme::dda,
                              Scheme::newmark, Scheme::backward_euler}) {
    Scene scene = slope_scene(20, 30);
    scene.analysis.scheme = scheme;
    scene.stages = {settling(scene, 10)};
    scene.stages[0].reset_displacements = false;
    BuiltScene built = build(scene);
    run(*built.stepper, 10);
    const Points before = built.stepper->blocks().displacements(built.stepper->state());
    run(*built.stepper, 1);
    const Points after = built.stepper->blocks().displacements(built.stepper->state());
    EXPECT_LE((after - before).norm(), 1e-6 * before.norm()) << static_cast<int>(scheme);
  }
}

/// Bricks one upon the other, the upper two by later stages: what is below bears what has come.
TEST(Stages, BlocksComeInWithTheirStages) {
  Scene scene = slope_scene(0, 30);
  scene.blocks.push_back(block(rectangle(0, 1, 2, 1)));
  scene.blocks.push_back(block(rectangle(0, 2, 2, 1)));
  Load push;
  push.block = 3;
  push.at = Vec2(1, 3);
  push.force.value = Vec2(0, -10e3);
  scene.loads = {push};
  scene.stages = {scene.stage("one"), scene.stage("two"), scene.stage("three"), scene.stage("fall")};
  for (StageDescription& stage : scene.stages) {
    stage.analysis.mode = Mode::statics;
    stage.analysis.steps = 30;
  }
  scene.stages[1].added = {2};
  scene.stages[2].added = {3};
  scene.stages[3].analysis.mode = Mode::dynamic;
  scene.stages[3].removed = {1};
  BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const double of_base = 9.8 * stepper.blocks().block(0).mass_total(), of_brick = 5000 * 9.8;
  for (int n = 1; n <= 3; ++n) {
    run(stepper, 30);
    EXPECT_EQ(stepper.blocks().n_present(), n + 1);
    const double load = n == 3 ? 10e3 : 0;
    EXPECT_NEAR(stepper.reactions().row(1).sum(), of_base + n * of_brick + load, 1e-3);
    EXPECT_TRUE(stepper.is_at_rest());
  }
  // What came in falls as what was there.
  run(stepper, 20);
  EXPECT_NEAR(travel(stepper, 2).y(), -9.8 / 2 * 0.2 * 0.2, 0.15 * 9.8 / 2 * 0.2 * 0.2);
  EXPECT_LT(std::abs(stepper.energy().balance_error()), 1e-6);
}

/// Blocks that do not touch are solved apart: what a stage brings reaches them too.
TEST(Stages, LoadsAndWaterThatComeInReachEveryIsland) {
  Scene scene = slope_scene(0, 20);
  scene.blocks.push_back(block(rectangle(5, 0, 2, 1)));
  scene.loads = {body_load(1, constant({12250, 0}))};  // half of the weight
  scene.stages = {scene.stage("before"), scene.stage("pushed")};
  scene.stages[0].analysis.steps = 5;
  scene.stages[1].analysis.steps = 50;
  scene.stages[1].loads = {0};
  const BuiltScene pushed = build(scene);
  run(*pushed.stepper, 55);
  const double a = 12250 / 2500. - 9.8 * std::tan(radians(20));
  EXPECT_NEAR(travel(*pushed.stepper, 1).x(), a * 0.5 * 0.5 / 2, 1e-3 * a);
  EXPECT_NEAR(travel(*pushed.stepper, 2).x(), 0, 1e-9);

  Scene wet = slope_scene(0, 20);
  wet.analysis.mode = Mode::statics;
  wet.blocks.push_back(block(rectangle(5, 0, 2, 1)));
  wet.stages = {wet.stage("dry"), wet.stage("flooded")};
  for (StageDescription& stage : wet.stages) stage.analysis.steps = 10;
  Points table(2, 2);
  table << -50, 50, 3, 3;
  wet.stages[1].water = {table, table, 1000};
  const BuiltScene flooded = build(wet);
  run(*flooded.stepper, 20);
  for (const ddacontact::ContactRecord& contact : flooded.stepper->contacts())
    EXPECT_NEAR(contact.normal, 0.6 * 49000 / 2, 1) << "buoyancy";
}

/// A rise over 0.1 s counts from when the load comes in.
TEST(Stages, ALoadThatComesInGrowsFromThenOn) {
  Scene scene = slope_scene(0, 30);
  scene.analysis.mode = Mode::statics;
  scene.loads = {point_load(1, Vec2(1, 1), constant({0, -10e3}))};
  scene.loads[0].force.rise = 0.1;
  scene.stages = {scene.stage("before"), scene.stage("loaded")};
  scene.stages[0].analysis.steps = 20;
  scene.stages[1].analysis.steps = 20;
  scene.stages[1].loads = {0};
  BuiltScene built = build(scene);
  run(*built.stepper, 20);
  const double before = built.stepper->reactions().row(1).sum();
  for (int k = 1; k <= 20; ++k) {
    run(*built.stepper, 1);
    EXPECT_NEAR(built.stepper->reactions().row(1).sum() - before, 1e3 * std::min(k, 10), 1) << k;
  }
}

TEST(Stages, ABlockDoesNotComeInWhereAnotherOneIs) {
  Scene scene = slope_scene(0, 30);
  scene.blocks[1].name = "slider";
  scene.blocks[1].velocity = Vec2(6, 0);
  scene.blocks.push_back(block(rectangle(4, 0, 1, 1)));
  scene.blocks[2].name = "late";
  scene.stages = {scene.stage("slide"), scene.stage("late")};
  scene.stages[1].added = {2};
  BuiltScene built = build(scene);
  run(*built.stepper, scene.stages[0].analysis.steps);
  EXPECT_FALSE(built.stepper->step());
  EXPECT_EQ(built.stepper->stop_reason(), "block \"late\" comes in where block \"slider\" is");
}

/// A beam of 60 kN on three springs of 1 MN/m, the middle one of which is taken out: from 20 mm to 30 mm.
class APillarTakenOut : public ::testing::Test {
 protected:
  static Scene scene(Mode mode, int relax, int steps) {
    Scene scene = default_mechanics(rock_scene(0.01, 1));
    scene.materials[0].young = 1e11;
    scene.materials[0].poisson = 0;
    scene.joints[0].friction_angle = 30;
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1.25e6;
    for (const double x : {0.0, 1.1, 2.2}) scene.blocks.push_back(block(rectangle(x, -1, 0.8, 1), true));
    scene.blocks.push_back(block(rectangle(0, 0, 3, 1)));
    scene.stages = {scene.stage("settle"), scene.stage("excavate")};
    scene.stages[0].analysis.mode = Mode::statics;
    scene.stages[0].analysis.steps = 20;
    scene.stages[0].analysis.time_step = 10;
    scene.stages[1].analysis.mode = mode;
    if (mode == Mode::statics)
      scene.stages[1].analysis.time_step = 10;
    else
      scene.stages[1].analysis.scheme = Scheme::midpoint;
    scene.stages[1].analysis.steps = steps;
    scene.stages[1].removed = {1};
    if (relax > 0) scene.stages[1].relax = relax;
    return scene;
  }
  static double settlement(const Stepper& stepper) { return -travel(stepper, 3).y(); }
  /// The deepest of the second stage.
  static double deepest(const Scene& scene) {
    BuiltScene built = build(scene);
    run(*built.stepper, 20);
    double deepest = 0;
    for (int k = 0; k < scene.stages[1].analysis.steps; ++k) {
      run(*built.stepper, 1);
      deepest = std::max(deepest, settlement(*built.stepper));
    }
    EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
    return deepest;
  }
};

TEST_F(APillarTakenOut, SettlesTheBeamInProportionToWhatIsGoneOfItsForce) {
  BuiltScene built = build(scene(Mode::statics, 10, 20));
  run(*built.stepper, 20);
  EXPECT_NEAR(settlement(*built.stepper), 0.02, 1e-7);
  for (int k = 1; k <= 20; ++k) {
    run(*built.stepper, 1);
    EXPECT_NEAR(settlement(*built.stepper), 0.02 + 0.001 * std::min(k, 10), 1e-6) << k;
  }
  EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-6);
}

TEST_F(APillarTakenOut, AtOnceLetsTheBeamGoTwiceAsFarAsWhenItsForceRelaxes) {
  const double period = 2 * std::numbers::pi / std::sqrt(2e6 / 6000);  // on two springs
  EXPECT_NEAR(deepest(scene(Mode::dynamic, 0, 60)), 0.04, 1e-4);
  // Of a ramp over T the beam swings by |sin(w T / 2)| / (w T / 2) of the change.
  for (const int steps : {50, 100, 200}) {
    const double half_angle = std::numbers::pi * steps * 0.01 / period;
    EXPECT_NEAR(deepest(scene(Mode::dynamic, steps, steps + 60)),
                0.03 + 0.01 * std::abs(std::sin(half_angle)) / half_angle, 1e-4)
        << steps;
  }
}

TEST(RunRecord, RefusesOtherBytes) {
  BuiltScene built = build(slope_scene(30, 20));
  const std::string bytes = to_bytes(built.stepper->run_record());
  for (std::size_t n = 0; n < bytes.size(); n += 7)
    EXPECT_THROW(run_record_from(bytes.substr(0, n)), Error) << n;
  EXPECT_THROW(run_record_from(bytes + "x"), Error);
}

/// What a support had prescribed before its block came in does not count; a displacement of the whole run is
/// reached at its end.
TEST(Stages, SupportsMoveABlockFromWhenItComesIn) {
  using Kind = TimeFunction::Kind;
  Scene scene = slope_scene(0, 30);
  scene.stages = {scene.stage("before"), scene.stage("after")};
  for (StageDescription& stage : scene.stages) stage.analysis.steps = 4;
  const double dt = scene.analysis.time_step, speed = 0.1;
  struct Motion {
    TimeFunction function;
    double first, last;
  };
  const std::vector<Motion> motions{{{Kind::rate, {speed, 0}, {}}, speed * dt, speed * 4 * dt},
                                    {{Kind::ramp, {4e-3, 0}, {}}, 1e-3, 4e-3},
                                    {{Kind::history, {0, 0}, {{0, 0, 0}, {8 * dt, 8e-3, 0}}}, 1e-3, 4e-3},
                                    {{Kind::constant, {0, 0}, {}}, 0, 0}};
  for (const BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    for (const auto& [function, first, last] : motions) {
      Scene jacked = scene;
      jacked.blocks.push_back(block(rectangle(0, 5, 1, 1)));
      jacked.supports = {{2, {0, 1, 2, 3}, true, true, function}};
      jacked.stages[1].added = {2};
      jacked.blocks[2].model = model;
      BuiltScene built = build(jacked);
      run(*built.stepper, 5);
      EXPECT_NEAR(travel(*built.stepper, 2).x(), first, 1e-12);
      run(*built.stepper, 3);
      EXPECT_NEAR(travel(*built.stepper, 2).x(), last, 1e-12);
    }
  }
}
