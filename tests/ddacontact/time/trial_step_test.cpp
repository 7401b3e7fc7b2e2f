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

/// Of the displacements of the vertices of a unit square by the paper's mechanics.
TrialEnd end_of_square(const Vec2& at_2, const Vec2& at_3) {
  Scene scene = rock_scene(0.01, 1);
  scene.blocks = {block(rectangle(0, 0, 1, 1))};
  scene.blocks[0].model = BlockModel::wachspress;
  TrialOf step(scene);
  TrialSolution solution = step.solve();
  solution.straight.setZero();
  solution.straight.segment<2>(4) = at_2 - Vec2(1, 1);
  solution.straight.segment<2>(6) = at_3 - Vec2(0, 1);
  return step.trial.advance(step.dt(), solution);
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

TEST(TrialStep, CountsTurnsOfABlockOn) {
  Scene scene = above_a_plate(Scheme::midpoint, 0.01, {0, 5}, {0, 0});
  scene.blocks[1].angular_velocity = 3;
  TrialOf step(scene);
  const TrialSolution solution = step.solve();
  for (const int turns : {0, 2, -1}) {
    step.state.rotation[1] = turns * 2 * std::numbers::pi;
    const double by = step.trial.advance(0.01, solution).state.rotation[1] - step.state.rotation[1];
    EXPECT_NEAR(by, 0.03, 1e-4);
  }
}

TEST(TrialStep, ASliderPressesByItsWeightAndIsSlowedByFriction) {
  constexpr double dt = 0.01, friction = 0.4;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda}) {
    Scene scene = above_a_plate(scheme, dt, {0, 0}, {1, 0});
    scene.materials[0].young = 1e14;
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
    EXPECT_GT(step.counts.open_close_iterations, 0);
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

/// By the trapezoidal rule the velocity at the end is that of the history there, not the mean over the step.
TEST(TrialStep, SupportsAreWhereTheyShouldBe) {
  constexpr double dt = 0.1;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda}) {
    Scene scene = default_mechanics(dt, scheme);
    scene.blocks = {block(rectangle(0.1, 0.3, 2, 1))};
    TimeFunction motion{TimeFunction::Kind::history, {}, {}};
    motion.history = {{0, 0, 0}, {0.1, 0.02, 0.01}, {0.2, 0.08, 0.01}};
    scene.supports = {{0, {0, 1, 2, 3}, true, true, motion}};
    TrialOf step(scene);
    const TrialEnd end = step.trial.advance(dt, step.solve());
    const Points moved = step.blocks.positions(end.state) - step.blocks.positions(step.state);
    EXPECT_LE((moved.colwise() - Vec2(0.02, 0.01)).norm(), 1e-15);
    expect_near(step.velocity(end.state, 0), scheme == Scheme::midpoint ? Vec2(0.4, 0.05) : Vec2(0.2, 0.1),
                1e-12);
  }
}

TEST(TrialStep, ABlockGoesOnConcaveButNotCrossedOrInsideOut) {
  const TrialEnd convex = end_of_square({1.1, 1}, {0, 1}), concave = end_of_square({0.4, 0.4}, {0, 1}),
                 crossed = end_of_square({-0.2, 0.5}, {0, 1}), inverted = end_of_square({1, -1}, {0, -1});
  EXPECT_TRUE(convex.rejection.empty() && convex.concave.empty());
  EXPECT_TRUE(concave.rejection.empty());
  EXPECT_EQ(concave.concave, std::vector<int>{0});
  EXPECT_NE(crossed.rejection.find("crosses itself"), std::string::npos) << crossed.rejection;
  EXPECT_NE(inverted.rejection.find("inside out"), std::string::npos) << inverted.rejection;
}

/// It meets the plate in the middle of the step and returns with half of its speed.
TEST(TrialStep, AnImpactWithinTheStepTurnsTheMotion) {
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint})
    for (const double restitution : {0., 0.5, 1.}) {
      Scene scene = above_a_plate(scheme, 0.01, {0, 0.005}, {0, -1});
      scene.analysis.gravity.setZero();
      scene.joints[0].restitution = restitution;
      TrialOf step(scene);
      const TrialSolution solution = step.solve();
      ASSERT_TRUE(solution.impact.changes());
      EXPECT_EQ(solution.impact.n_hits, 2);
      expect_near(step.mean_motion(solution.motion(), 1), {0, -0.005 * (1 - restitution)}, 1e-8);
      const TrialEnd end = step.trial.advance(0.01, solution);
      expect_near(step.velocity(end.state, 1), {0, restitution}, 1e-5);
      expect_near(step.blocks.displacements(end.state).col(4), {0, -0.005 * (1 - restitution)}, 1e-7);
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

/// A corner flies at a corner, along the diagonal as far as its velocity tells: gravity makes it pass the
/// line along it last, and that one it meets.
TEST(TrialStep, TheMotionOfTheStepTellsWhichLineACornerMeets) {
  for (const bool downwards : {true, false}) {
    Scene scene = default_mechanics(0.02);
    scene.analysis.gravity = downwards ? Vec2(0, -g) : Vec2(-g, 0);
    scene.blocks = {block(rectangle(0, 0, 1, 1), true), block(rectangle(1.005, 1.005, 1, 1))};
    scene.blocks[1].velocity = {-0.4, -0.4};
    TrialOf step(scene);
    const TrialSolution solution = step.solve();
    ASSERT_TRUE(solution.rejection.empty());
    EXPECT_GT(step.counts.corner_solutions, 0);
    EXPECT_EQ(step.counts.unsettled_corners, 0);
    const auto pressed = [](const Contact& of) { return of.normal > 0; };
    ASSERT_EQ(std::ranges::count_if(step.trial.contacts(), pressed), 1);
    const Contact& contact = *std::ranges::find_if(step.trial.contacts(), pressed);
    EXPECT_EQ(contact.pair.edge % 2, downwards ? 1 : 0) << "edges 1 and 3 are upright";
    EXPECT_NEAR(contact.gap, 0, 1e-6);
    const Vec2 corner = step.blocks.block(1).vertex_map(0)(solution.motion());
    EXPECT_LT(downwards ? corner.y() : corner.x(), -0.009) << "past the other line";
  }
}
