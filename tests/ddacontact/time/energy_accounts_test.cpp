#include <ddacontact/time/energy_accounts.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

namespace {

/// A block dropped from 2 cm upon a plane, with a velocity along it.
Scene dropped(BlockModel model) {
  Scene scene = rock_scene(0.005, 100);
  scene.joints[0].friction_angle = 20;
  scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, 0.02, 2, 1))};
  scene.blocks[1].velocity = {2, 0};
  scene.blocks[1].model = model;
  return scene;
}

}  // namespace

TEST(EnergyAccounts, TheLedgerOfADroppedAndSlidingBlockCloses) {
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    const BuiltScene built = build(dropped(model));
    double friction = 0;
    for (int k = 0; k < 100; ++k) {
      run(*built.stepper, 1);
      const EnergyLedger& ledger = built.stepper->energy();
      EXPECT_LE(std::abs(ledger.balance_error()), 1e-3) << "step " << k;
      EXPECT_GE(ledger.now.friction_dissipated, friction - 1e-9);
      friction = ledger.now.friction_dissipated;
    }
    const Stepper& stepper = *built.stepper;
    const double mass = 4000, start = mass * 2 * 2 / 2;
    const Energy& e = stepper.energy().now;
    EXPECT_NEAR(e.gravity, mass * 10 * travel(stepper, 1).y(), 1e-4 * start);
    EXPECT_NEAR(e.friction_dissipated, std::tan(radians(20)) * mass * 10 * travel(stepper, 1).x(),
                0.05 * start);
    EXPECT_NEAR(e.kinetic, momentum(stepper, 1).squaredNorm() / (2 * mass), 1e-2 * start);
    EXPECT_EQ(e.external, 0);
    EXPECT_EQ(e.damping_dissipated, 0);

    // Every entry matters: without it the account is open.
    for (double Energy::*entry :
         {&Energy::kinetic, &Energy::gravity, &Energy::friction_dissipated, &Energy::numerical_dissipated}) {
      Energy corrupt = e;
      corrupt.*entry *= 0.9;
      const double error = std::abs(corrupt.total() - e.total()) / start;
      EXPECT_GT(error, 3 * std::abs(stepper.energy().balance_error()));
    }
  }
}

/// Loads and moved supports do their work.
TEST(EnergyAccounts, TheWorkOfLoadsAndSupportsIsCounted) {
  Scene scene = rock_scene(0.01, 50);
  scene.analysis.gravity.setZero();
  scene.blocks = {block(rectangle(0, 0, 2, 1)), block(rectangle(0, 5, 2, 1)), block(rectangle(9, 0, 1, 1))};
  scene.loads = {body_load(0, constant({1e3, 0}))};
  scene.supports = {{1,
                     {0, 1, 2, 3},
                     true,
                     true,
                     {TimeFunction::Kind::history, {0, 0}, {{0, 0, 0}, {0.25, 0.2, 0}, {0.5, 0.8, 0}}}}};
  scene.blocks[2].velocity = {0, 1};
  const BuiltScene built = run(scene);
  const Stepper& stepper = *built.stepper;
  // The load accelerates 4 t by 2 kN; the support takes 4 t to 2.4 m/s.
  const double by_load = 2e3 * travel(stepper, 0).x(), by_support = 4e3 * 2.4 * 2.4 / 2;
  EXPECT_NEAR(travel(stepper, 0).x(), 0.5 * 0.5 * 0.5 * 0.5, 1e-9);
  EXPECT_NEAR(stepper.energy().now.kinetic, by_load + by_support + 1e3, 1e-6 * by_support);
  EXPECT_NEAR(stepper.energy().now.external - stepper.energy().now.numerical_dissipated, by_load + by_support,
              1e-6 * by_support);
  EXPECT_LE(std::abs(stepper.energy().balance_error()), 1e-10);
}

TEST(EnergyAccounts, AStaticStepLeavesNothingInMotionAlsoNotItsMovingSupports) {
  for (BlockModel model : {BlockModel::wachspress, BlockModel::affine}) {
    Scene scene = rock_scene(0.1, 10);
    scene.analysis.mode = Mode::statics;
    scene.blocks = {block(rectangle(0, 0, 2, 1))};
    scene.blocks[0].model = model;
    scene.supports = {{0, {0, 1}, true, true, {TimeFunction::Kind::rate, {0, 0.02}, {}}}};
    const BuiltScene built = build(scene);
    for (int k = 0; k < 10; ++k) {
      run(*built.stepper, 1);
      EXPECT_EQ(built.stepper->energy().now.kinetic, 0);
      EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-3);
    }
    EXPECT_NEAR(travel(*built.stepper, 0).y(), 0.02, 1e-3);
  }
}

TEST(EnergyAccounts, RoundOffOfAFreeFlightIsNoExchange) {
  Scene scene = rock_scene(0.01, 50);
  scene.analysis.gravity.setZero();
  scene.blocks = {block(rectangle(0, 0, 2, 1))};
  scene.blocks[0].velocity = {3, 1};
  const BuiltScene built = build(scene);
  for (int k = 0; k < 50; ++k) {
    run(*built.stepper, 1);
    EXPECT_EQ(built.stepper->energy().balance_error(), 0);
  }
}

TEST(EnergyAccounts, KineticEnergyIsThatOfBlocksThatMove) {
  Scene scene = rock_scene(0.01, 1);
  scene.blocks = {block(rectangle(0, 0, 2, 1)), block(rectangle(5, 0, 1, 1)),
                  block(rectangle(9, 0, 1, 1), true)};
  scene.blocks[0].velocity = {3, 4};
  scene.blocks[1].angular_velocity = 2;
  const BuiltScene built = build(scene);
  VectorXd velocity = built.stepper->state().velocity;
  velocity.tail(8).setConstant(7);
  EXPECT_NEAR(kinetic_energy(built.stepper->blocks(), velocity), 4000 * 25. / 2 + 2000. / 6 * 4 / 2, 1e-9);
}

/// Springs store unless they are open or only multipliers; on the slip while they stick.
TEST(EnergyAccounts, SpringsStoreAsTheirContactsAre) {
  ContactProperties properties{100, 40, JointTable(JointStrength{}), {0, 0}};
  ContactRecord contact;
  contact.pair = {0, 0, 1, 0};
  contact.end_gap = -0.2;
  contact.end_slip = 0.5;
  for (const auto& [state, stored] :
       {std::pair{ContactState::open, 0.}, {ContactState::stick, 2. + 5}, {ContactState::slip_forward, 2.}}) {
    contact.history.state = state;
    EXPECT_DOUBLE_EQ(spring_energy({contact, contact}, properties), 2 * stored);
  }
  properties.method = ContactMethod::staged;
  properties.penetration_tolerance = 1e-6;
  contact.history.state = ContactState::stick;
  EXPECT_EQ(spring_energy({contact}, properties), 0);
}

TEST(EnergyAccounts, HeldVerticesStoreInTheDirectionsThatAreHeld) {
  Scene scene = rock_scene(0.01, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1))};
  BuiltScene built = build(scene);
  blocks_of(built).fixed_vertices = {{0, 2, true, false, {}}};
  BlockState state = built.stepper->state();
  state.position.col(2) += Vec2(0.1, 0.7);
  const ContactProperties properties{100, 40, JointTable(JointStrength{}), {0}};
  EXPECT_NEAR(elastic_energy(built.stepper->blocks(), state, {}, properties), 100 * 0.01 / 2, 1e-12);
}

/// A block set free hangs from vertices that moving springs hold; what is left is of second order in its
/// strain.
TEST(EnergyAccounts, TheLedgerOfHoldingSpringsCloses) {
  Scene scene = rock_scene(0.01, 20);
  scene.analysis.preset = Preset::paper;
  scene.blocks = {block(rectangle(0, 0, 2, 1))};
  scene.blocks[0].model = BlockModel::affine;
  scene.contact.normal_stiffness = 1e8;
  scene.supports = {{0, {2}, true, true, {TimeFunction::Kind::rate, {0.1, 0.1}, {}}},
                    {0, {3}, true, true, {TimeFunction::Kind::rate, {0.1, 0.1}, {}}}};
  const BuiltScene built = run(scene);
  ASSERT_EQ(built.stepper->blocks().fixed_vertices.size(), 4u);
  EXPECT_GT(std::abs(built.stepper->energy().now.external), 1);
  EXPECT_LE(std::abs(built.stepper->energy().balance_error()), 1e-5);
}
