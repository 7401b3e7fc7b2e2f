#include <polyfem/element/definiteness.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

MatrixXd diagonal(std::initializer_list<double> entries) {
  VectorXd d(static_cast<Index>(entries.size()));
  std::copy(entries.begin(), entries.end(), d.begin());
  return d.asDiagonal();
}

TEST(Definiteness, CountsZeroModesAndRelatesTheOthersToTheLargest) {
  const Definiteness definite = judge(diagonal({4, 0, 1e-14, -1e-14, 2, 8}), diagonal({1, 1, 2, 2, 4, 4}));
  EXPECT_EQ(definite.zero_modes, 3);
  EXPECT_DOUBLE_EQ(definite.least_stiffness, 0.25);
  EXPECT_DOUBLE_EQ(definite.least_mass, 0.25);
  EXPECT_TRUE(definite.definite());
}

TEST(Definiteness, IsDeniedToMechanismsAndIndefiniteMatrices) {
  const MatrixXd good_mass = MatrixXd::Identity(6, 6), good_stiffness = diagonal({0, 0, 0, 1, 2, 3});
  EXPECT_TRUE(judge(good_stiffness, good_mass).definite());
  EXPECT_FALSE(judge(diagonal({0, 0, 0, 0, 2, 3}), good_mass).definite());
  EXPECT_FALSE(judge(good_stiffness, diagonal({1, 1, 1, 1, -1e-9, 1})).definite());
  EXPECT_FALSE(judge(MatrixXd::Zero(6, 6), good_mass).definite());
  const Definiteness indefinite = judge(diagonal({0, 0, 0, -0.5, 2, 4}), good_mass);
  EXPECT_EQ(indefinite.zero_modes, 3);
  EXPECT_DOUBLE_EQ(indefinite.least_stiffness, -0.125);
  EXPECT_FALSE(indefinite.definite());
}

TEST(CompareEnergies, FindsTheLeastAndTheLargestOfAllDeformations) {
  const MatrixXd reference = diagonal({0, 0, 0, 1, 10, 1e6});
  const EnergyRange energy = compare_energies(diagonal({0, 0, 0, 2, 5, 1e6}), reference);
  EXPECT_NEAR(energy.least, 0.5, 1e-12);
  EXPECT_NEAR(energy.largest, 2, 1e-12);
  EXPECT_NEAR(compare_energies(diagonal({0, 0, 0, 1, 0, 1e6}), reference).least, 0, 1e-12) << "a mechanism";
  EXPECT_TRUE(std::isnan(compare_energies(reference, diagonal({0, 0, 0, 0, -1, 1})).least));
}

}  // namespace
