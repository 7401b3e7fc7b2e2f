#include <ddacontact/time/energy_accounts.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

using namespace support;

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
  ContactProperties properties{100, 40, JointTable(JointStrength{}), {0, 0}, ContactMethod::classic, 0};
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
  const ContactProperties properties{100, 40, JointTable(JointStrength{}), {0}, ContactMethod::classic, 0};
  EXPECT_NEAR(elastic_energy(built.stepper->blocks(), state, {}, properties), 100 * 0.01 / 2, 1e-12);
}
