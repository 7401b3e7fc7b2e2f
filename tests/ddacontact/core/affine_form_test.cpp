#include <ddacontact/core/affine_form.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <set>

using namespace ddacontact;

TEST(AffineForm, IsTheSumOfItsTermsHoweverTheyAreMerged) {
  std::mt19937 random(1);
  const VectorXd d = VectorXd::Random(20);
  for (int trial = 0; trial < 200; ++trial) {
    AffineForm form;
    form.constant = support::uniform(-1, 1, random);
    double sum = 0;
    VectorXd gradient = VectorXd::Zero(20);
    for (int term = 0; term < 40; ++term) {
      const int unknown = 1 + std::uniform_int_distribution<int>(0, AffineForm::capacity - 1)(random);
      const double c = support::uniform(-1, 1, random);
      form.add(unknown, c);
      sum += c * d[unknown];
      gradient[unknown] += c;
    }
    EXPECT_NEAR(form.change(d), sum, 1e-13);
    EXPECT_NEAR(form(d), form.constant + sum, 1e-13);
    const std::set<int> distinct(form.unknowns().begin(), form.unknowns().end());
    EXPECT_EQ(distinct.size(), form.unknowns().size());
    EXPECT_EQ(form.unknowns().size(), form.coefficients().size());

    VectorXd F = VectorXd::Ones(20);
    form.add_gradient(-2, F);
    EXPECT_LE((F - VectorXd::Ones(20) + 2 * gradient).lpNorm<Eigen::Infinity>(), 1e-13);
  }
}
