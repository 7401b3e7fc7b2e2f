#include <ddacontact/time/motion_accounts.hpp>
#include <tests/ddacontact/time/trial_of.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A block of 2 m2 and 40 kN in flight.
Scene flying_block(const Vec2& velocity) {
  Scene scene = default_mechanics(0.01);
  scene.blocks = {block(rectangle(0, 0, 2, 1))};
  scene.blocks[0].velocity = velocity;
  return scene;
}

Energy energy_of_step(TrialOf& step) {
  const TrialSolution solution = step.solve();
  Energy energy;
  std::vector<Contact> contacts = step.trial.contacts();
  account_motion_step(step.trial.system(), step.state, solution.straight, solution.residual, contacts,
                      energy);
  return energy;
}

}  // namespace

/// A load that grows from nothing works with its mean over the step; the first one is computed with that of
/// its first half.
TEST(MotionAccounts, AGrowingLoadWorksWithItsMean) {
  TrialOf still(flying_block({1, 0})), grows(flying_block({1, 0}));
  grows.blocks.body_loads = {{0, {TimeFunction::Kind::rate, {700 / 0.01, 0}, {}}}};
  const Energy without = energy_of_step(still), with = energy_of_step(grows);
  const double computed = grows.trial.system().load_forces().dot(grows.solve().straight);
  EXPECT_NEAR(computed, 2 * 175 * 0.01, 0.01);
  EXPECT_NEAR(with.external, computed, 1e-9);
  EXPECT_NEAR(with.numerical_dissipated - without.numerical_dissipated, with.external + computed, 1e-9);
}

/// A block that a support moves evenly from rest: its reaction works on the way.
TEST(MotionAccounts, SupportsWorkByTheirReactions) {
  Scene scene = flying_block({0, 0});
  scene.analysis.gravity.setZero();
  scene.supports = {{0, {0, 1, 2, 3}, true, true, {TimeFunction::Kind::rate, {0.5, 0}, {}}}};
  TrialOf step(scene);
  const TrialSolution solution = step.solve();
  double work = 0;
  for (const PrescribedDof& held : step.blocks.prescribed_dofs())
    work += solution.residual.force[held.unknown] * (held.axis == 0 ? 0.5 * 0.01 : 0);
  EXPECT_GT(work, 0);
  EXPECT_NEAR(energy_of_step(step).external, work, 1e-9 * work);
}
