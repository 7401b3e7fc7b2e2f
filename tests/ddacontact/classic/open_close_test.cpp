#include <ddacontact/classic/open_close.hpp>
#include <ddacontact/classic/spring_law.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;
using enum ContactState;

namespace {

/// One step of a block of 2 x 1 m (40 kN) on a fixed plane, friction 0.5, under an additional force in its
/// centre.
struct OneStep {
  BuiltScene built;
  StepSystem system;
  std::vector<Contact> contacts;
  VectorXd d;
  ContactSolverReport report;

  explicit OneStep(const Vec2& force, double cohesion = 0)
      : built(build(scene(force, cohesion))), system(blocks_of(built)) {
    contacts = built.stepper->contacts_to_begin_with();
    const BlockState& state = built.stepper->state();
    system.set_step(state, step_start(state, 0.1), 1e9);
    report = iterate_open_close(system, contacts, d);
  }
  static Scene scene(const Vec2& force, double cohesion) {
    Scene s = rock_scene(0.1, 1);
    s.analysis.mode = Mode::statics;
    s.joints[0].friction_angle = std::atan(0.5) * 180 / std::numbers::pi;
    s.joints[0].cohesion = cohesion;
    s.blocks = {block(rectangle(-2, -1, 6, 1), true), block(rectangle(0, 0, 2, 1))};
    s.loads = {point_load(1, {1, 0.5}, constant(force))};
    return s;
  }
  double normal(const Contact& c) const { return normal_force(c.law, c.gap - c.history.gap_offset); }
  void expect_states(ContactState state) const {
    ASSERT_EQ(contacts.size(), 2u);
    for (const Contact& c : contacts) EXPECT_EQ(static_cast<int>(c.history.state), static_cast<int>(state));
  }
};

}  // namespace

TEST(OpenClose, ABlockAtRestSticksAndItsResidualPasses) {
  const OneStep trial({0, 0});
  EXPECT_EQ(trial.report.status, SolutionStatus::settled);
  EXPECT_TRUE(trial.report.residual.balanced(1e-8));
  trial.expect_states(stick);
  for (const Contact& c : trial.contacts) EXPECT_TRUE(c.history.bonded && c.was_closed);
}

TEST(OpenClose, ABlockPushedBeyondFrictionSlidesInTheSenseOfThePush) {
  for (double push : {-30e3, 30e3}) {
    const OneStep trial({push, 0});
    EXPECT_EQ(trial.report.status, SolutionStatus::settled);
    EXPECT_TRUE(trial.report.residual.balanced(1e-8));
    ASSERT_EQ(trial.contacts.size(), 2u);
    double friction = 0;
    for (const Contact& c : trial.contacts) {
      // The plane's upper edge runs from right to left.
      EXPECT_EQ(c.history.state, push > 0 ? slip_backward : slip_forward);
      EXPECT_GT(slip_sign(c.history.state) * c.slip_change, 0);
      friction += 0.5 * trial.normal(c);
      // What the contact is left with is (52) of the present penetration, against the slip.
      EXPECT_NEAR(c.normal, trial.normal(c), 1e-12 * c.normal);
      EXPECT_NEAR(c.shear, -slip_sign(c.history.state) * 0.5 * c.normal, 1e-12 * c.normal);
    }
    // d = a dt^2 / 2 from rest: the block's acceleration tells the friction that acted.
    const Block& slider = trial.built.stepper->blocks().block(1);
    const VectorXd d = trial.d.segment(slider.unknowns().first, slider.n_unknowns());
    const double force = slider.translations().col(0).dot(slider.mass() * d) * 2 / 0.01;
    EXPECT_NEAR(std::abs(force), 30e3 - friction, 1e-7 * 30e3);
  }
}

TEST(OpenClose, ABlockPulledHarderThanItsWeightLiftsOff) {
  const OneStep trial({5e3, 41e3});
  EXPECT_EQ(trial.report.status, SolutionStatus::settled);
  trial.expect_states(open);
  for (const Contact& c : trial.contacts) {
    EXPECT_TRUE(c.was_closed);
  }
}

/// States that settle agree with the solution that they lead to: asked again, none changes.
TEST(OpenClose, SettledStatesAgreeWithTheirSolution) {
  for (const Vec2& force :
       {Vec2(0, 0), Vec2(15e3, 0), Vec2(25e3, -10e3), Vec2(-30e3, 20e3), Vec2(35e3, 30e3)}) {
    const OneStep trial(force);
    ASSERT_EQ(trial.report.status, SolutionStatus::settled);
    for (const Contact& c : trial.contacts) {
      const Trial seen{.gap = c.gap - c.history.gap_offset,
                       .slip = c.end_slip,
                       .slip_increment = c.slip_change,
                       .tolerance = c.length_tolerance(),
                       .bonded = c.history.bonded};
      EXPECT_EQ(next_state(c.history.state, c.law, seen), c.history.state);
    }
  }
}

TEST(OpenClose, WithoutContactsOneSolutionIsEnough) {
  Scene scene = rock_scene(0.1, 1);
  scene.blocks = {block(rectangle(0, 0, 2, 1))};
  BuiltScene built = build(scene);
  StepSystem system(blocks_of(built));
  std::vector<Contact> none;
  VectorXd d;
  system.set_step(built.stepper->state(), step_start(built.stepper->state(), 0.1), 1e9);
  const ContactSolverReport report = iterate_open_close(system, none, d);
  EXPECT_EQ(report.status, SolutionStatus::settled);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_EQ(report.worst_contact, -1);
}
