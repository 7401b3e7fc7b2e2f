// Where the blocks are at the end of a step.
#include <tests/ddacontact/time/trial_of.hpp>

using namespace support;

namespace {

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

TEST(TrialStepEnd, CountsTurnsOfABlockOn) {
  Scene scene = default_mechanics(0.01, Scheme::midpoint);
  scene.blocks = {block(rectangle(0, 5, 2, 1))};
  scene.blocks[0].angular_velocity = 3;
  TrialOf step(scene);
  const TrialSolution solution = step.solve();
  for (const int turns : {0, 2, -1}) {
    const double before = turns * 2 * std::numbers::pi + 0.01;
    step.state.rotation[0] = before;
    EXPECT_NEAR(step.trial.advance(0.01, solution).state.rotation[0], before + 0.02, 1e-4);
  }
}

/// Where accelerations are constant or linear the velocity at the end is that of the history there, else the
/// mean over the step.
TEST(TrialStepEnd, SupportsAreWhereTheyShouldBe) {
  constexpr double dt = 0.1;
  for (const Scheme scheme : {Scheme::decaying, Scheme::midpoint, Scheme::dda, Scheme::backward_euler}) {
    Scene scene = default_mechanics(dt, scheme);
    scene.blocks = {block(rectangle(0.1, 0.3, 2, 1))};
    TimeFunction motion{TimeFunction::Kind::history, {}, {}};
    motion.history = {{0, 0, 0}, {0.1, 0.02, 0.01}, {0.2, 0.08, 0.01}};
    scene.supports = {{0, {0, 1, 2, 3}, true, true, motion}};
    TrialOf step(scene);
    const TrialEnd end = step.trial.advance(dt, step.solve());
    const Points moved = step.blocks.positions(end.state) - step.blocks.positions(step.state);
    EXPECT_LE((moved.colwise() - Vec2(0.02, 0.01)).norm(), 1e-15);
    const bool at_end = scheme == Scheme::midpoint || scheme == Scheme::dda;
    const Vec2 velocity = at_end ? Vec2(0.4, 0.05) : Vec2(0.2, 0.1);
    EXPECT_LE((step.velocity(end.state, 0) - velocity).norm(), 1e-12);
  }
}

TEST(TrialStepEnd, ABlockGoesOnConcaveButNotCrossedOrInsideOut) {
  const TrialEnd convex = end_of_square({1.1, 1}, {0, 1}), concave = end_of_square({0.4, 0.4}, {0, 1}),
                 crossed = end_of_square({-0.2, 0.5}, {0, 1}), inverted = end_of_square({1, -1}, {0, -1});
  EXPECT_TRUE(convex.rejection.empty() && convex.concave.empty());
  EXPECT_TRUE(concave.rejection.empty());
  EXPECT_EQ(concave.concave, std::vector<int>{0});
  EXPECT_NE(crossed.rejection.find("crosses itself"), std::string::npos) << crossed.rejection;
  EXPECT_NE(inverted.rejection.find("inside out"), std::string::npos) << inverted.rejection;
}
