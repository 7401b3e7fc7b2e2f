// Forces of bolts as derivatives of what they store, and their stiffness as the derivative of the forces.
#include <tests/ddacontact/simple_scenes.hpp>

#include <ddacontact/equations/step_bolt.hpp>

#include <random>

using namespace support;

namespace {

/// Ten segments of .1 m, E A = 8e7 N, bonded by 1e9 N/m2; nothing but its numbers counts here.
Bolt bar_of_ten(bool grouted) {
  Bolt bolt;
  bolt.nodes.resize(11);
  bolt.stiffness = 8e7;
  if (grouted) bolt.bonded.assign(11, 0.1);
  bolt.bond_stiffness = 1e9;
  bolt.numbers = {0, bolt.n_numbers()};
  return bolt;
}
VectorXd new_numbers(const Bolt& bolt) {
  VectorXd numbers = VectorXd::Zero(bolt.n_numbers());
  for (int k = 0; k < bolt.n_segments(); ++k) numbers[Bolt::length(k)] = 0.1;
  return numbers;
}
VectorXd any_elongations(std::mt19937& random, double size) {
  std::normal_distribution<double> normal(0, size);
  return VectorXd::NullaryExpr(10, [&] { return normal(random); });
}

}  // namespace

TEST(BoltLaw, ForcesOfElasticBarsAreDerivativesOfWhatTheyStore) {
  std::mt19937 random(1);
  for (const bool grouted : {false, true}) {
    const Bolt bolt = bar_of_ten(grouted);
    const VectorXd numbers = new_numbers(bolt), u = any_elongations(random, 1e-4);
    const BoltForces forces = bolt_forces(bolt, numbers, u);
    for (int k = 0; k < 10; ++k) {
      const double h = 1e-7;
      const VectorXd by = h * VectorXd::Unit(10, k);
      const double derivative =
          (bolt_forces(bolt, numbers, u + by).stored - bolt_forces(bolt, numbers, u - by).stored) / (2 * h);
      EXPECT_NEAR(forces.axial[k], derivative, 1e-5 * forces.axial.norm());
    }
  }
}

TEST(BoltLaw, StiffnessIsTheDerivativeOfForcesWhateverYields) {
  std::mt19937 random(2);
  for (int round = 0; round < 20; ++round) {
    Bolt bolt = bar_of_ten(true);
    bolt.yield = 20e3;
    bolt.bond_strength = 60e3;
    const VectorXd numbers = new_numbers(bolt), u = any_elongations(random, 1e-4);
    const BoltForces forces = bolt_forces(bolt, numbers, u);
    EXPECT_LE(forces.axial.cwiseAbs().maxCoeff(), 20e3);
    EXPECT_LE(forces.bond.cwiseAbs().maxCoeff(), 60e3 * 0.1 * (1 + 1e-12));
    for (int i = 1; i < 10; ++i)  // each piece of the bar is in balance
      EXPECT_NEAR(forces.axial[i] - forces.axial[i - 1], forces.bond[i], 1e-3);
    const double h = 1e-10;
    for (int k = 0; k < 10; ++k) {
      const VectorXd by = h * VectorXd::Unit(10, k);
      const VectorXd derivative =
          (bolt_forces(bolt, numbers, u + by).axial - bolt_forces(bolt, numbers, u - by).axial) / (2 * h);
      EXPECT_LE((forces.stiffness.col(k) - derivative).norm(), 1e-3 * 8e8) << round << ' ' << k;
    }
  }
}

/// There, back by the same way and beyond: bars and bonds unload and yield in the other sense.
TEST(BoltLaw, YieldingIsKeptAndDissipatesWhatIsNotStored) {
  std::mt19937 random(3);
  for (const bool grouted : {false, true}) {
    Bolt bolt = bar_of_ten(grouted);
    bolt.yield = 20e3;
    bolt.bond_strength = 60e3;
    VectorXd numbers = new_numbers(bolt), u = VectorXd::Zero(10);
    const VectorXd way = any_elongations(random, 2e-4);
    double work = 0, dissipated = 0;
    const int n = 2000;
    for (int step = 0; step < 3 * n; ++step) {
      const VectorXd before = bolt_forces(bolt, numbers, u).axial, by = (step < n ? way : -way) / n;
      u += by;
      work += (before + bolt_forces(bolt, numbers, u).axial).dot(by) / 2;
      const double lost = follow(bolt, u, numbers).dissipated;
      ASSERT_GE(lost, -1e-9 * work);
      dissipated += lost;
    }
    const BoltForces end = bolt_forces(bolt, numbers, u);
    EXPECT_GT(dissipated, 0.1 * work);
    EXPECT_NEAR(work, end.stored + dissipated, 1e-3 * work);
    EXPECT_NEAR(follow(bolt, u, numbers).dissipated, 0, 1e-9 * work);  // nothing yields twice
  }
}

/// Elastically: what it bears in tension afterwards is as before.
TEST(BoltLaw, ABarBucklesAndBearsNoMoreCompression) {
  Bolt bolt = bar_of_ten(false);
  bolt.buckling = 300;
  bolt.yield = 50e3;
  VectorXd numbers = new_numbers(bolt);
  for (const double u : {-1e-7, -1e-4, -1e-2}) {
    const VectorXd elongation = VectorXd::Constant(10, u);
    const BoltForces forces = bolt_forces(bolt, numbers, elongation);
    EXPECT_DOUBLE_EQ(forces.axial[3], std::max(-300., 8e7 * u / 0.1));
    EXPECT_EQ(forces.stiffness(3, 3) > 0, u == -1e-7);
    EXPECT_EQ(follow(bolt, elongation, numbers).dissipated, 0);
    const VectorXd by = 1e-3 * u * VectorXd::Unit(10, 3);
    const double derivative = (bolt_forces(bolt, numbers, elongation + by).stored -
                               bolt_forces(bolt, numbers, elongation - by).stored) /
                              (2 * by[3]);
    EXPECT_NEAR(derivative, forces.axial[3], 1e-6 * 300);
  }
  EXPECT_EQ(numbers, new_numbers(bolt));
  EXPECT_DOUBLE_EQ(bolt_forces(bolt, numbers, VectorXd::Constant(10, 1e-5)).axial[3], 8e7 * 1e-4);
}

TEST(BoltLaw, ATornSegmentBearsNothingAndTheRestGoesOn) {
  Bolt bolt = bar_of_ten(true);
  bolt.rupture_strain = 1e-3;
  VectorXd numbers = new_numbers(bolt);
  const VectorXd u = 1e-3 * VectorXd::Unit(10, 4);
  const double before = bolt_forces(bolt, numbers, u).stored;
  const BoltLosses losses = follow(bolt, u, numbers);
  const BoltForces after = bolt_forces(bolt, numbers, u);
  EXPECT_TRUE(losses.tears);
  EXPECT_EQ(after.axial[4], 0);
  EXPECT_NEAR(losses.dissipated, before - after.stored, 1e-9 * before);
}
