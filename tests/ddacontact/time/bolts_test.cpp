// Anchored and grouted bolts against closed forms, and through all that happens to a run.
#include <tests/ddacontact/time/bolted_scenes.hpp>
#include <tests/ddacontact/time/staged_scenes.hpp>

#include <ddacontact/scene/reader.hpp>

using namespace support;

TEST(Bolts, BearTheWeightOfABlockThatHangsOnOne) {
  for (const auto& [scheme, model] : {std::pair{Scheme::midpoint, BlockModel::wachspress},
                                      {Scheme::midpoint, BlockModel::affine},
                                      {Scheme::midpoint, BlockModel::mesh},
                                      {Scheme::midpoint, BlockModel::mean_value},
                                      {Scheme::decaying, BlockModel::wachspress},
                                      {Scheme::dda, BlockModel::wachspress}}) {
    Scene scene = hanging_block(1, 40);
    scene.analysis.mode = Mode::statics;
    scene.analysis.scheme = scheme;
    scene.materials[0].young = 1e9;
    scene.blocks[1].model = model;
    scene.bolts[0].spacing = 2;
    const BuiltScene built = run(scene);
    EXPECT_NEAR(axial(*built.stepper), weight, 1e-8 * weight);
    const double stretch = weight * 5 / (bar_stiffness / 2);
    EXPECT_NEAR(view_of(*built.stepper).elongation(0), stretch, 1e-8 * stretch);
    EXPECT_STREQ(view_of(*built.stepper).state(0), "elastic");
    double reaction = 0;
    for (Index v = 0; v < 4; ++v) reaction += built.stepper->reactions()(1, v);
    EXPECT_NEAR(reaction, 2 * weight, 1e-8 * weight);  // that of the fixed block too
    expect_closed(*built.stepper);
  }
}

/// Backward Euler turns the phase by atan(w dt) a step and takes 1 + (w dt)^2 of the energy.
TEST(Bolts, DecayAsJointsDoByTheDefaultScheme) {
  Scene scene = hanging_block(0.002, 50);
  scene.analysis.scheme = Scheme::decaying;
  scene.bolts[0].pretension = weight;  // about equilibrium
  scene.blocks[1].velocity = {0, -0.1};
  const double w = std::sqrt(bar_stiffness / 5 / 4000), wdt = w * 0.002;
  const BuiltScene built = build(scene);
  std::vector<double> y;
  for (int k = 0; k < 50; ++k) {
    run(*built.stepper, 1);
    y.push_back(travel(*built.stepper, 1).y());
  }
  for (std::size_t k = 2; k < y.size(); ++k)
    EXPECT_NEAR(y[k] - 2 * y[k - 1] + y[k - 2], -wdt * wdt * y[k], 1e-6 * 0.1 / w * wdt * wdt);
  expect_closed(*built.stepper);
}

TEST(Bolts, FollowTheirEndsThroughLargeRotations) {
  for (const Scheme scheme : {Scheme::midpoint, Scheme::decaying, Scheme::central_difference}) {
    Scene scene = hanging_block(0.01, 400);
    if (scheme == Scheme::central_difference) scene.materials[0].young = 1e8;
    scene.analysis.scheme = scheme;
    scene.analysis.gravity = Vec2::Zero();
    scene.blocks[0].vertices = rectangle(0.9, 9.9, 0.2, 0.2);
    scene.blocks[1].velocity = {6, 0};
    const BuiltScene built = run(scene);
    // It circles the fixed end with its speed: the bar bears m v^2 / r.
    EXPECT_NEAR((centre(*built.stepper, 1) - centre(*built.stepper, 0)).norm(), 5, 0.05);
    EXPECT_NEAR(momentum(*built.stepper, 1).norm() / 4000, 6, 0.3);
    expect_closed(*built.stepper);
    if (scheme == Scheme::midpoint) {
      const Energy& now = built.stepper->energy().now;
      EXPECT_NEAR(now.kinetic + now.elastic, 72e3, 1e-6 * 72e3);
    }
  }
}

/// 40 kN on two bolts of 1 m, drawn aside by 4 kN: u = l tan(alpha), tan(alpha) = 1/10. Tension turns bolts
/// back by T / l, which is more than the block's inertia in steps longer than 2 sqrt(m l / T), 0.63 s.
TEST(Bolts, HoldABlockDrawnAsideInStepsOfAnyLength) {
  for (const Mode mode : {Mode::statics, Mode::dynamic})
    for (const double time_step : {0.1, 1.0, 10.0}) {
      Scene scene = hanging_block(time_step, mode == Mode::statics ? 100 : 300);
      scene.analysis.scheme = Scheme::decaying;
      scene.analysis.mode = mode;
      scene.analysis.gravity = {1, -10};
      if (mode == Mode::dynamic) scene.analysis.damping.mass = 1;
      scene.blocks[0].vertices = rectangle(0, 6, 2, 1);
      scene.bolts = {steel_bolt({0.2, 6.5}, {0.2, 5.5}), steel_bolt({1.8, 6.5}, {1.8, 5.5})};
      scene.bolts[1].name = "b2";
      for (RockBolt& bolt : scene.bolts) bolt.area = 0.04;
      scene.blocks[1].vertices = rectangle(0, 4.5, 2, 1);
      const BuiltScene built = run(scene);
      const double stretched = 1 + weight * std::sqrt(1.01) / 2 / 8e9, aside = stretched / std::sqrt(101.0);
      EXPECT_NEAR((centre(*built.stepper, 1) - centre(*built.stepper, 0)).x(), aside, 1e-4 * aside)
          << time_step << " s, " << (mode == Mode::statics ? "static" : "dynamic");
      expect_closed(*built.stepper);
    }
}

TEST(Bolts, YieldAtTheirYieldForceAndTakeTheWorkOfIt) {
  for (const Scheme scheme : {Scheme::midpoint, Scheme::decaying, Scheme::dda}) {
    Scene scene = hanging_block(0.001, 400);
    scene.analysis.scheme = scheme;
    scene.bolts[0].yield_force = 60e3;
    scene.blocks[1].velocity = {0, -1};
    const BuiltScene built = build(scene);
    double largest = 0;
    bool yields = false;
    for (int k = 0; k < 400; ++k) {
      run(*built.stepper, 1);
      largest = std::max(largest, axial(*built.stepper));
      yields = yields || std::string(view_of(*built.stepper).state(0)) == "yield";
    }
    EXPECT_TRUE(yields);
    EXPECT_NEAR(largest, 60e3, 1e-9 * 60e3);
    // m v^2 / 2 + W s = Y (s - s_elastic) + Y s_elastic / 2; it swings by (Y - W) / k below that.
    const double elastic = 60e3 * 5 / bar_stiffness,
                 way = (2000 - 60e3 * elastic / 2 + 60e3 * elastic) / (60e3 - weight),
                 work = 60e3 * (way - elastic);
    EXPECT_NEAR(-travel(*built.stepper, 1).y(), way, 0.03 * way);
    EXPECT_NEAR(built.stepper->energy().now.plastic_dissipated, work, 0.04 * work);
    expect_closed(*built.stepper);
    EXPECT_LE(built.stepper->energy().created(), 1e-6);
  }
}

/// A bar of 3 cm2 and 3 m leans down the slope, so that slip shortens it: it buckles at 1.6 kN, and a block of 98
/// kN slides as it does without it.
TEST(Bolts, DoNotPropWhatSlidesAgainstThem) {
  const auto travelled = [](bool bolted) {
    Scene scene = slope_scene(25, 22);
    scene.blocks[1].vertices = turned(rectangle(0, 0, 2, 2), -radians(25));
    scene.materials[0].density = 2500;
    const auto place = [](double x, double y) -> Vec2 { return turned(Points(Vec2(x, y)), -radians(25)); };
    if (bolted) {
      scene.bolts = {steel_bolt(place(0.5, 1.5), place(2.6, -0.6))};
      scene.bolts[0].area = 3e-4;
      scene.bolts[0].yield_force = 60e3;
      scene.bolts[0].pretension = 20e3;
    }
    const BuiltScene built = run(scene);
    EXPECT_TRUE(!bolted || view_of(*built.stepper).state(0) == std::string("buckled"));
    return travel(*built.stepper, 1).norm();
  };
  const double free = travelled(false), bolted = travelled(true);
  EXPECT_GT(free, 0.04);
  EXPECT_NEAR(bolted, free, 0.3 * free) << "what 1.6 kN and the pretension change";
}

TEST(Bolts, TearBeyondTheirRuptureStrain) {
  Scene scene = hanging_block(0.001, 200);
  scene.bolts[0].yield_force = 60e3;
  scene.bolts[0].rupture_strain = 0.002;
  scene.blocks[1].velocity = {0, -1};
  const BuiltScene built = run(scene);
  EXPECT_STREQ(view_of(*built.stepper).state(0), "torn");
  EXPECT_EQ(axial(*built.stepper), 0);
  // It tears after 5 m x .002, and what it stores then is lost too.
  const double elastic = 60e3 * 5 / bar_stiffness, work = 60e3 * (0.01 - elastic / 2);
  EXPECT_GT(built.stepper->energy().now.plastic_dissipated, work);
  EXPECT_LT(built.stepper->energy().now.plastic_dissipated, work + 60e3 * 0.001);  // a step more
  const double v0 = momentum(*built.stepper, 1).y() / 4000;
  run(*built.stepper, 100);
  EXPECT_NEAR(momentum(*built.stepper, 1).y() / 4000 - v0, -1, 1e-9);
  expect_closed(*built.stepper);
  ASSERT_FALSE(built.stepper->notes().empty());
  EXPECT_NE(built.stepper->notes().back().find("\"b1\" has torn"), std::string::npos);
}

TEST(Bolts, ClampBlocksByTheirPretension) {
  Scene scene = bolted_pair();
  scene.materials[0].young = 1e9;
  scene.joints[0].friction_angle = 40;
  scene.bolts[0].pretension = 80e3;
  const BuiltScene built = run(scene);
  const double force = axial(*built.stepper);
  EXPECT_NEAR(closed_contacts(*built.stepper), force, 1e-8 * force);
  EXPECT_LT(force, 80e3);  // the rock gives way a little
  EXPECT_GT(force, 70e3);
  // Friction bears what the clamping allows.
  for (const double part : {0.98, 1.02}) {
    Scene loaded = scene;
    loaded.materials[0].young = 1e12;
    loaded.bolts[0].young = 2e9;
    const double most = 80e3 * std::tan(radians(40));
    loaded.loads = {point_load(1, {2.1, 0.5}, constant({0, -part * most}))};
    loaded.analysis.steps = 4;
    const BuiltScene sheared = run(loaded);
    const double way = -travel(*sheared.stepper, 1).y();
    EXPECT_EQ(way > 1e-4, part > 1) << way;
  }
}

/// Under a force F at the joint each half of length l slips by F / (E A b) coth(b l), b^2 = bond / (E A).
TEST(Bolts, GroutedOnesOpenAJointAsTheClosedForm) {
  for (const double bond : {2e7, 1e9, 1e10}) {
    Scene scene = grouted_pair();
    scene.bolts[0].bond_stiffness = bond;
    scene.bolts[0].to = {3, 0.5};  // 1.75 m in one block, 1 m in the other
    scene.loads = {point_load(1, {2.5, 0.5}, constant({100e3, 0}))};
    const BuiltScene built = run(scene);
    const double b = std::sqrt(bond / bar_stiffness),
                 opening = 100e3 / (bar_stiffness * b) * (1 / std::tanh(1.75 * b) + 1 / std::tanh(1.0 * b));
    EXPECT_NEAR(travel(*built.stepper, 1).x(), opening, 0.01 * opening) << bond;
    const Bolt& bolt = built.stepper->blocks().bolts[0];
    EXPECT_NEAR(axial(*built.stepper, at_joint(bolt)), 100e3, 1e-8 * 100e3);
    // The force fades as sinh b (l - x) / sinh b l.
    double x = 2;
    const BoltView view = view_of(*built.stepper);
    for (int k = at_joint(bolt) + 1; k < bolt.n_segments(); ++k) {
      x += bolt.bonded[static_cast<std::size_t>(k)];
      EXPECT_NEAR(view.axial(k), 100e3 * std::sinh(b * (3 - x)) / std::sinh(b), 0.01 * 100e3);
    }
  }
}

TEST(Bolts, GroutedOnesArePulledOutAtTheStrengthOfTheirBond) {
  Scene scene = grouted_pair();
  scene.bolts[0].to = {3, 0.5};
  scene.bolts[0].bond_strength = 80e3;
  scene.supports = {{1, {0, 1, 2, 3}, true, true, {TimeFunction::Kind::rate, {1e-4, 0}, {}}}};
  scene.analysis.steps = 60;
  const BuiltScene built = run(scene);
  const Bolt& bolt = built.stepper->blocks().bolts[0];
  EXPECT_NEAR(axial(*built.stepper, at_joint(bolt)), 80e3 * 1, 1e-6 * 80e3);
  EXPECT_STREQ(view_of(*built.stepper).state(bolt.n_segments() - 1), "slip");
  const Energy& now = built.stepper->energy().now;
  EXPECT_GT(now.plastic_dissipated, 0.8 * 80e3 * 5e-3);
  EXPECT_NEAR(now.external, now.plastic_dissipated + now.elastic, 0.02 * now.external);
  expect_closed(*built.stepper);
}

/// A bond that is symmetric about the joint slips at both sides at once; then the bar is held by nothing.
/// A pretension that the bond cannot bear: it has slipped when the run begins, which costs and gains nothing.
TEST(Bolts, GroutedOnesBeginWithWhatTheirBondBears) {
  Scene scene = grouted_pair();
  scene.bolts[0].bond_strength = 4e4;
  scene.bolts[0].pretension = 2e5;
  const BuiltScene built = run(scene);
  const Energy& now = built.stepper->energy().now;
  EXPECT_NEAR(axial(*built.stepper, at_joint(built.stepper->blocks().bolts[0])), 4e4 * 1.75, 0.005 * 7e4);
  EXPECT_LT(now.plastic_dissipated, 1e-3 * now.elastic);
  EXPECT_LT(std::abs(now.numerical_dissipated), 1e-3 * now.elastic);
  expect_closed(*built.stepper);
}

TEST(Bolts, MayBePulledOutOfBothBlocksAtOnce) {
  Scene scene = grouted_pair();
  scene.bolts[0].bond_strength = 10e3;
  scene.supports = {{1, {0, 1, 2, 3}, true, true, {TimeFunction::Kind::rate, {1e-4, 0}, {}}}};
  const BuiltScene built = run(scene);
  EXPECT_NEAR(axial(*built.stepper, at_joint(built.stepper->blocks().bolts[0])), 10e3 * 1.75, 1e-6 * 17.5e3);
  expect_closed(*built.stepper);
}

TEST(Bolts, DoNotDependOnTheOrderOfBlocksAndBolts) {
  Scene scene = grouted_pair();
  scene.analysis.mode = Mode::dynamic;
  scene.analysis.time_step = 0.002;
  scene.analysis.gravity = {20, -10};
  scene.joints[0].friction_angle = 30;
  scene.bolts[0].yield_force = 15e3;
  Scene reversed = scene;
  std::swap(reversed.blocks[0], reversed.blocks[1]);
  std::swap(reversed.bolts[0].from, reversed.bolts[0].to);
  const BuiltScene one = run(scene), other = run(reversed);
  const Vec2 way = travel(*one.stepper, 1);
  EXPECT_LE((way - travel(*other.stepper, 0)).norm(), 1e-8 * way.norm());
}

/// Two hanging blocks and a stack at rest: with islands and sleep, and all together.
TEST(Bolts, StepsMayLeaveOutWhatRests) {
  Scene scene = hanging_block(0.005, 100);
  scene.analysis.scheme = Scheme::decaying;
  scene.materials[0].young = 1e9;
  for (const double x : {10.0, 20.0}) {
    scene.blocks.push_back(block(rectangle(x, 9.5, 2, 1), true));
    scene.blocks.push_back(block(rectangle(x, 4.5, 2, 1)));
    scene.bolts.push_back(steel_bolt({x + 1, 10}, {x + 1, 5}));
    scene.bolts.back().name = "b" + std::to_string(static_cast<int>(x));
  }
  scene.bolts[2].yield_force = 45e3;
  for (int k = 0; k < 4; ++k) scene.blocks.push_back(block(rectangle(30, k, 2, 1), k == 0));
  Scene together = scene;
  together.analysis.skip.islands = together.analysis.skip.sleep = false;
  const BuiltScene one = run(scene), other = run(together);
  for (int b = 0; b < 10; ++b)
    EXPECT_LE((travel(*one.stepper, b) - travel(*other.stepper, b)).norm(), 1e-9) << b;
  EXPECT_TRUE(one.stepper->is_asleep(9));
  EXPECT_LE((one.stepper->reactions() - other.stepper->reactions()).cwiseAbs().maxCoeff(), 1e-3);
  expect_closed(*one.stepper);
  EXPECT_NEAR(one.stepper->energy().now.elastic, other.stepper->energy().now.elastic, 1e-6);
}

/// 150 kN, which the bolts bear where they leave the wedge; without the right one the wedge comes down.
TEST(Bolts, HangTheWedgeOfTheExampleInItsRoof) {
  const Scene scene = read_scene(EXAMPLES "/bolted_roof.toml").scene.value();
  const BuiltScene built = run(scene);
  Vec2 sum = Vec2::Zero();
  const BlockSystem& blocks = built.stepper->blocks();
  for (std::size_t b = 0; b < 3; ++b) {
    const Bolt& bolt = blocks.bolts[b];
    const int k = at_joint(bolt);
    sum += view_of(*built.stepper, static_cast<int>(b)).axial(k) *
           segment_vector(bolt, k, blocks, built.stepper->state()).normalized();
  }
  EXPECT_NEAR(sum.y(), 150e3, 1e-3 * 150e3);
  EXPECT_TRUE(built.stepper->is_at_rest());
  EXPECT_LT(-travel(*built.stepper, 2).y(), 2e-3);
}
