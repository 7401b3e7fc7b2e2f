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

TEST(Energy, TheLedgerOfADroppedAndSlidingBlockCloses) {
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
TEST(Energy, TheWorkOfLoadsAndSupportsIsCounted) {
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

TEST(EnergyLedger, BalancesAgainstTheLargestEnergyExchangedSoFar) {
  EnergyLedger ledger;
  ledger.now.kinetic = 100;
  ledger.start();
  ledger.close_step();
  EXPECT_EQ(ledger.balance_error(), 0);  // nothing exchanged
  ledger.now.kinetic = 60;
  ledger.now.gravity = 40;
  ledger.close_step();
  EXPECT_EQ(ledger.balance_error(), 0);
  ledger.now.kinetic = 90;
  ledger.now.gravity = 12;
  ledger.close_step();
  EXPECT_DOUBLE_EQ(ledger.balance_error(), 2. / 40);
  for (double Energy::*dissipated : {&Energy::elastic, &Energy::friction_dissipated,
                                     &Energy::numerical_dissipated, &Energy::damping_dissipated}) {
    EnergyLedger other = ledger;
    other.now.*dissipated = 4;
    EXPECT_DOUBLE_EQ(other.balance_error(), 6. / 40);
  }
  ledger.now.external = 2;
  EXPECT_DOUBLE_EQ(ledger.balance_error(), 0);
}

TEST(Energy, AStaticStepLeavesNothingInMotionAlsoNotItsMovingSupports) {
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

TEST(Energy, RoundOffOfAFreeFlightIsNoExchange) {
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
