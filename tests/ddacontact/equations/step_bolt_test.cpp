#include <ddacontact/equations/step_bolt.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

namespace {

/// A bar of 5 m and 2 m through three blocks, installed under tension.
struct InstalledBar {
  BuiltScene built;
  BlockState state;

  explicit InstalledBar(double pretension, double yield = Bolt::infinity) : built(build(scene())) {
    BlockSystem& blocks = blocks_of(built);
    Bolt bar;
    for (const int b : {0, 1, 2}) bar.nodes.push_back({b, VectorXd::Constant(4, 0.25)});
    bar.stiffness = 6e6;
    bar.pretension = pretension;
    bar.yield = yield;
    blocks.set_bolts({bar});
    state = blocks.initial_state();
    install(blocks.bolts[0], blocks, state);
  }
  static Scene scene() {
    Scene scene = rock_scene(0.1, 1);
    scene.blocks = {block(rectangle(0, 0, 1, 1)), block(rectangle(3, 4, 1, 1)), block(rectangle(5, 4, 1, 1))};
    scene.blocks[1].model = BlockModel::affine;
    return scene;
  }
  const BlockSystem& blocks() const { return built.stepper->blocks(); }
  StepBolt begun(Directions directions) const {
    StepBolt step(blocks(), blocks().bolts[0]);
    step.begin(blocks(), state, directions);
    return step;
  }
  /// The first node moves by this and the last one by the opposite, as rigid bodies.
  VectorXd pulled(const Vec2& by) const {
    VectorXd d = VectorXd::Zero(blocks().n_unknowns());
    for (const int b : {0, 2}) {
      const Block& of = blocks().block(b);
      d.segment(of.unknowns().first, of.n_unknowns()) = (b == 0 ? 1 : -1) * of.translations() * by;
    }
    return d;
  }
};

constexpr Directions all_directions[] = {Directions::of_start, Directions::mean, Directions::of_end};

VectorXd forces_at(StepBolt& step, const VectorXd& d) {
  VectorXd F = VectorXd::Zero(d.size());
  step.evaluate(d);
  step.add_forces(F);
  return F;
}

}  // namespace

TEST(StepBolt, NodesArePulledTowardsEachOtherAndForcesBalance) {
  for (const Directions directions : all_directions) {
    const InstalledBar bar(3e4);
    StepBolt step = bar.begun(directions);
    EXPECT_EQ(step.blocks(), (std::vector<int>{0, 1, 2}));
    EXPECT_NEAR(step.largest_stiffness(), 6e6 / 2, 1e-6);
    step.evaluate(VectorXd::Zero(bar.blocks().n_unknowns()));
    EXPECT_LE((step.force_on(0) - 3e4 * Vec2(0.6, 0.8)).norm(), 1e-7);
    EXPECT_LE((step.force_on(2) - Vec2(-3e4, 0)).norm(), 1e-7);
    EXPECT_LE((step.force_on(0) + step.force_on(1) + step.force_on(2)).norm(), 1e-7);
    const VectorXd F = forces_at(step, bar.pulled({-0.1, 0.05}));
    for (const int b : {0, 1, 2}) {
      const Block& of = bar.blocks().block(b);
      const Vec2 on = of.translations().transpose() * F.segment(of.unknowns().first, of.n_unknowns());
      EXPECT_LE((on - step.force_on(b)).norm(), 1e-7);
    }
  }
}

/// Of the length that the bar has at the end of the step its force is EA / L of the elongation more.
TEST(StepBolt, FollowsTheDirectionThatTheSchemeAsksFor) {
  const InstalledBar bar(0);
  const VectorXd d = bar.pulled({-3, 0});  // the first segment becomes (6, 4), the last one shortens to none
  const double force = 6e6 / 5 * (std::sqrt(52.) - 5);
  StepBolt at_start = bar.begun(Directions::of_start), at_end = bar.begun(Directions::of_end),
           mean = bar.begun(Directions::mean);
  for (StepBolt* step : {&at_start, &at_end, &mean}) step->evaluate(d);
  EXPECT_LE((at_start.force_on(0) - force * Vec2(0.6, 0.8)).norm(), 1e-6);
  EXPECT_LE((at_end.force_on(0) - force * Vec2(6, 4) / std::sqrt(52.)).norm(), 1e-6);
  EXPECT_LE((mean.force_on(0) - force / 2 * Vec2(9, 8) / (5 + std::sqrt(52.))).norm(), 1e-6);
}

/// With means the work of the step is what the bar stores, however far it turns.
TEST(StepBolt, MeanForcesDoTheWorkThatIsStored) {
  InstalledBar bar(3e4);
  StepBolt step = bar.begun(Directions::mean);
  for (const Vec2& by : {Vec2(-0.5, 2), Vec2(0.3, 0.1)}) {
    const VectorXd d = bar.pulled(by), F = forces_at(step, d);
    const auto stored = [&](const Vec2& first, const Vec2& last) {
      const double a = first.norm() - 5 + 3e4 * 5 / 6e6, b = last.norm() - 2 + 3e4 * 2 / 6e6;
      return 6e6 * (a * a / 5 + b * b / 2) / 2;
    };
    const double change = stored(Vec2(3, 4) - by, Vec2(2, 0) - by) - stored({3, 4}, {2, 0});
    EXPECT_NEAR(F.dot(d), -change, 1e-9 * std::abs(change));
    EXPECT_EQ(step.end(bar.state.bolts).dissipated, 0);
  }
}

TEST(StepBolt, TheTangentOfATensionBarIsTheDerivative) {
  for (const Directions directions : {Directions::of_start, Directions::of_end}) {
    const InstalledBar bar(3e5);
    StepBolt step = bar.begun(directions);
    // Of forces along the start it is exact there.
    const VectorXd d = (directions == Directions::of_end) * bar.pulled({-0.1, 0.05});
    step.evaluate(d);
    const MatrixXd K = step.tangent();
    const std::vector<int>& u = step.unknowns();
    ASSERT_EQ(K.rows(), static_cast<Index>(u.size()));
    EXPECT_LE((K - K.transpose()).norm(), 1e-12 * K.norm());
    for (std::size_t k = 0; k < u.size(); ++k) {
      const VectorXd h = 1e-6 * VectorXd::Unit(d.size(), u[k]);
      const VectorXd derivative = (forces_at(step, d - h) - forces_at(step, d + h))(u) / 2e-6;
      EXPECT_LE((K.col(static_cast<Index>(k)) - derivative).norm(), 1e-6 * K.norm());
    }
  }
}

/// A bar that yields all the way takes its yield force times what it lengthens by.
TEST(StepBolt, YieldingTakesTheForceTimesTheWay) {
  for (const Directions directions : all_directions) {
    InstalledBar bar(3e4, 3e4);
    StepBolt step = bar.begun(directions);
    step.evaluate(bar.pulled({-0.06, -0.08}));
    VectorXd numbers = bar.state.bolts;
    const BoltLosses losses = step.end(numbers);
    const double last = std::hypot(2.06, 0.08) - 2;
    EXPECT_NEAR(losses.dissipated, 3e4 * (0.1 + last), 1e-6);
    EXPECT_FALSE(losses.tears);
    EXPECT_NEAR(numbers[Bolt::plastic(0)] - bar.state.bolts[Bolt::plastic(0)], 0.1, 1e-12);
  }
}

/// What is neither stored nor given back has yielded, with means too.
TEST(StepBolt, WorkIsStoredOrLostToYielding) {
  InstalledBar bar(1e4, 3e4);
  StepBolt step = bar.begun(Directions::mean);
  const VectorXd d = bar.pulled({-0.06, -0.08}), F = forces_at(step, d);
  VectorXd numbers = bar.state.bolts;
  const double change = (3e4 * 3e4 - 1e4 * 1e4) * (5 + 2) / (2 * 6e6);
  EXPECT_NEAR(step.end(numbers).dissipated, -F.dot(d) - change, 1e-8);
}
