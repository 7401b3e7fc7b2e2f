// One step, solved and carried out without a stepper.
#include <tests/ddacontact/time/trial_of.hpp>

using namespace support;

namespace {

constexpr double g = 10, mass = 4000;  // of a block of 2 m2

/// A block above a fixed one, with its lower left corner there.
Scene above_a_plate(Scheme scheme, double dt, const Vec2& at, const Vec2& velocity) {
  Scene scene = default_mechanics(dt, scheme);
  scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(at.x(), at.y(), 2, 1))};
  scene.blocks[1].velocity = velocity;
  return scene;
}

void expect_near(const Vec2& is, const Vec2& should, double tolerance) {
  EXPECT_LE((is - should).norm(), tolerance) << is.transpose() << " and not " << should.transpose();
}

}  // namespace

TEST(TrialStep, CarriesABlockInFlightOnAParabola) {
  constexpr double dt = 0.02;
  const Vec2 v(3, 1), gravity(0, -g);
  for (const Scheme scheme : {Scheme::decaying, Scheme::central_difference, Scheme::midpoint, Scheme::dda,
                              Scheme::newmark, Scheme::backward_euler}) {
    TrialOf step(above_a_plate(scheme, dt, {0, 5}, v));
    const TrialSolution solution = step.solve();
    const TrialEnd end = step.trial.advance(dt, solution);
    EXPECT_TRUE(solution.rejection.empty() && end.rejection.empty() && end.concave.empty());
    EXPECT_TRUE(step.trial.contacts().empty());
    const double part = scheme == Scheme::backward_euler ? 1 : 0.5;
    expect_near(step.mean_motion(solution.motion(), 1), dt * v + part * dt * dt * gravity, 1e-10);
    EXPECT_DOUBLE_EQ(end.state.time, dt);
    // With half steps it goes on with the velocity in the middle of this one.
    const bool half = scheme == Scheme::decaying || scheme == Scheme::central_difference;
    expect_near(step.velocity(end.state, 1), v + (half ? 0.5 : 1) * dt * gravity, 1e-9);
    EXPECT_EQ(end.state.carried_dt, half ? dt : 0);
    expect_near(step.blocks.displacements(end.state).col(4), dt * v + part * dt * dt * gravity, 1e-9);
    EXPECT_EQ(step.state.time, 0) << "a trial changes nothing";
  }
}

TEST(TrialStep, ASliderPressesByItsWeightAndIsSlowedByFriction) {
  constexpr double dt = 0.01, friction = 0.4;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda}) {
    Scene scene = above_a_plate(scheme, dt, {0, 0}, {1, 0});
    scene.materials[0].young = 1e13;  // with ten times as much round-off of gaps is 20 N
    scene.joints[0].friction_angle = std::atan(friction) * 180 / std::numbers::pi;
    TrialOf step(scene);
    const TrialSolution solution = step.solve();
    ASSERT_TRUE(solution.rejection.empty());
    EXPECT_NEAR(step.normal_force(), mass * g, 1e-5 * mass * g);
    for (const Contact& contact : step.trial.contacts()) {
      EXPECT_NEAR(std::abs(contact.shear), friction * contact.normal, 1e-9 * mass * g);
      EXPECT_TRUE(is_slipping(contact.history.state));
    }
    EXPECT_NEAR(step.mean_motion(solution.motion(), 1).x(), dt - friction * g * dt * dt / 2, 1e-6);
    EXPECT_GT(step.counts.contact_iterations, 0);
    EXPECT_GT(step.counts.factorizations + step.counts.sweeps, 0);
  }
}

/// A bond that tore in a trial bears again in the next one.
TEST(TrialStep, EverySolutionBeginsWithTheContactsOfTheStart) {
  for (const ContactMethod method : {ContactMethod::staged, ContactMethod::classic}) {
    Scene scene = above_a_plate(Scheme::dda, 0.01, {0, 0}, {0, 0});
    scene.contact.method = method;
    scene.analysis.gravity.setZero();
    scene.joints[0] = {"joint", 30, 1e6, 1e5, std::nullopt};
    TrialOf step(scene);
    step.detect();
    const auto bonds_under = [&](double force) {
      step.blocks.body_loads = {{1, constant({0, force})}};
      EXPECT_TRUE(step.trial.solve(0.01).rejection.empty());
      return std::ranges::count_if(step.trial.contacts(),
                                   [](const Contact& of) { return of.closed() && of.history.bonded; });
    };
    EXPECT_EQ(bonds_under(5e4), 2);
    const double pulled = step.normal_force();
    EXPECT_NEAR(pulled, -1e5, 2e3);
    EXPECT_EQ(bonds_under(2e6), 0);
    EXPECT_EQ(bonds_under(5e4), 2);
    EXPECT_NEAR(step.normal_force(), pulled, 1e-6 * std::abs(pulled));
  }
}

TEST(TrialStep, AStaticStepKnowsNoVelocitiesAndLeavesNone) {
  VectorXd settled;
  for (const double speed : {0., 3.}) {
    Scene scene = above_a_plate(Scheme::decaying, 1, {0, 0}, {speed, 0});
    scene.analysis.mode = Mode::statics;
    scene.joints[0].friction_angle = 30;
    TrialOf step(scene);
    const TrialSolution solution = step.solve();
    const TrialEnd end = step.trial.advance(1, solution);
    EXPECT_NEAR(step.normal_force(), mass * g, 1e-6 * mass * g);
    EXPECT_EQ(end.state.velocity.norm() + end.state.carried.norm(), 0);
    EXPECT_EQ(end.state.carried_dt, 0);
    if (speed > 0) {
      EXPECT_LE((solution.d - settled).norm(), 1e-12);
    }
    settled = solution.d;
  }
}

TEST(TrialStep, TakesInTheContactThatLetAVertexThrough) {
  TrialOf step(above_a_plate(Scheme::decaying, 0.02, {0, 0.01}, {0, -2}));
  step.detect();
  step.trial.contacts().clear();
  TrialEnd end = step.trial.advance(0.02, step.trial.solve(0.02));
  EXPECT_LT(step.blocks.displacements(end.state)(1, 4), -0.04);
  ASSERT_TRUE(step.trial.take_missed(end.state));
  EXPECT_EQ(step.trial.contacts().size(), 2u);
  end = step.trial.advance(0.02, step.trial.solve(0.02));
  EXPECT_NEAR(step.blocks.displacements(end.state)(1, 4), -0.01, 1e-5);
  EXPECT_FALSE(step.trial.take_missed(end.state));
}
