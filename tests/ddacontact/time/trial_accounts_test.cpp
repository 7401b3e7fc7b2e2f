// What one accepted trial adds to the energies, by hand.
#include <ddacontact/time/trial_accounts.hpp>
#include <tests/ddacontact/time/trial_of.hpp>

using namespace support;

namespace {

constexpr double weight_of_block = 40e3;  // N

/// A trial of a block and the energies that it adds.
struct Accounted {
  TrialOf step;
  TrialSolution solution;
  Energy energy;

  explicit Accounted(const Scene& scene) : step(scene), solution(step.solve()) {
    account({step.blocks, step.state, step.trial, solution}, energy);
  }
  Vec2 motion() const { return step.mean_motion(solution.motion(), 1); }
};

/// A block over a plate: `height` above it, moving to the right.
Scene over_a_plate(Scheme scheme, double height, double velocity, double friction_angle = 0) {
  Scene scene = default_mechanics(0.01, scheme);
  scene.materials[0].young = 1e14;
  scene.joints[0].friction_angle = friction_angle;
  scene.blocks = {block(rectangle(-2, -1, 12, 1), true), block(rectangle(0, height, 2, 1))};
  scene.blocks[1].velocity = {velocity, 0};
  return scene;
}

constexpr Scheme half_steps_and_whole[] = {Scheme::decaying, Scheme::midpoint};

}  // namespace

TEST(TrialAccounts, InFlightOnlyWeightWorks) {
  for (const Scheme scheme : half_steps_and_whole) {
    const Accounted flight(over_a_plate(scheme, 5, 3));
    EXPECT_NEAR(flight.energy.gravity, weight_of_block * flight.motion().y(), 1e-9);
    EXPECT_LT(flight.energy.gravity, 0);
    EXPECT_EQ(flight.energy.friction_dissipated, 0);
    EXPECT_EQ(flight.energy.external, 0);
    EXPECT_EQ(flight.energy.pushed_out, 0);
  }
}

TEST(TrialAccounts, ALoadWorksAlongTheMotion) {
  for (const Scheme scheme : half_steps_and_whole) {
    Scene scene = over_a_plate(scheme, 5, 3);
    scene.loads = {body_load(1, constant({700, 0}))};  // N/m3
    const Accounted pushed(scene);
    EXPECT_NEAR(pushed.energy.external, 2 * 700 * pushed.motion().x(), 1e-9);
  }
}

/// With its mean over the step: by half steps the step itself has that of another time.
TEST(TrialAccounts, ALoadThatGrowsWorksWithItsMean) {
  for (const Scheme scheme : half_steps_and_whole) {
    Scene scene = over_a_plate(scheme, 5, 3);
    scene.loads = {body_load(1, {TimeFunction::Kind::rate, {700 / 0.01, 0}, {}})};
    const Accounted pushed(scene);
    EXPECT_NEAR(pushed.energy.external, 2 * 350 * pushed.motion().x(), 1e-9);
  }
}

TEST(TrialAccounts, FrictionTakesItsForceTimesTheSlip) {
  for (const Scheme scheme : half_steps_and_whole) {
    const Accounted sliding(over_a_plate(scheme, 0, 3, 30));
    const double slip = sliding.motion().x(), friction = std::tan(radians(30)) * weight_of_block;
    EXPECT_GT(slip, 0.02);
    EXPECT_NEAR(sliding.energy.friction_dissipated, friction * slip, 1e-4 * friction * slip);
    EXPECT_NEAR(sliding.energy.pushed_out, 0, 1e-6 * friction * slip);
  }
}

TEST(TrialAccounts, ADashpotTakesNothingOfABlockThatLeaves) {
  for (const Scheme scheme : half_steps_and_whole) {
    Scene scene = over_a_plate(scheme, 0, 0);
    scene.joints[0].dashpot = 0.5;
    scene.blocks[1].velocity = {0, 2};
    Accounted leaving(scene);
    EXPECT_EQ(leaving.step.normal_force(), 0);
    ASSERT_GT(leaving.step.trial.contacts().at(0).damping, 0);
    EXPECT_EQ(leaving.energy.damping_dissipated, 0);
  }
}

TEST(TrialAccounts, ADashpotTakesItsForceTimesTheApproach) {
  Scene scene = over_a_plate(Scheme::midpoint, 5e-4, 0);
  scene.joints[0].dashpot = 0.01;
  scene.blocks[1].velocity = {0, -0.1};
  Accounted landing(scene);
  double taken = 0;
  for (const Contact& contact : landing.step.trial.contacts())
    taken += contact.damping * contact.gap_change * contact.gap_change;
  EXPECT_GT(taken, 1);
  EXPECT_NEAR(landing.energy.damping_dissipated, taken, 1e-9 * taken);
}

/// A contact without restitution stops a block: what that had is damped, not lost by the scheme.
TEST(TrialAccounts, AContactTakesTheKineticEnergyOfWhatItStops) {
  Scene scene = over_a_plate(Scheme::decaying, 0, 0);
  scene.analysis.gravity.setZero();
  scene.blocks[1].velocity = {0, -2};
  const Accounted landing(scene);
  const double kinetic = 4000 * 2 * 2 / 2;
  EXPECT_NEAR(landing.energy.damping_dissipated, kinetic, 1e-3 * kinetic);
  EXPECT_EQ(landing.energy.pushed_out, 0);
}

TEST(TrialAccounts, AnImpactIsSharedBetweenFrictionAndContacts) {
  StepImpact impact;
  Energy energy;
  impact.friction_loss = 3;
  impact.normal_loss = 5;
  account_impact(impact, energy);
  EXPECT_EQ(energy.friction_dissipated, 3);
  EXPECT_EQ(energy.damping_dissipated, 5);
  EXPECT_EQ(energy.numerical_dissipated, -8) << "the kinetic energy that went is not the scheme's loss";

  impact.friction_loss = 9;  // of impulses that are not unique: more than all
  impact.normal_loss = -1;
  Energy other;
  account_impact(impact, other);
  EXPECT_EQ(other.friction_dissipated, 8);
  EXPECT_EQ(other.damping_dissipated, 0);
}

TEST(TrialAccounts, KineticEnergyIsWhatInertiaHasMade) {
  Energy energy;
  energy.kinetic = 10;
  energy.numerical_dissipated = 4;
  book_kinetic(13, energy);
  EXPECT_EQ(energy.kinetic, 13);
  EXPECT_EQ(energy.numerical_dissipated, 1);
}
