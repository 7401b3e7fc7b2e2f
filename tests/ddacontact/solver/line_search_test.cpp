#include <ddacontact/solver/line_search.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>
#include <vector>

using namespace ddacontact;

namespace {

/// Derivative of the potential along the line, from its definition.
double slope_at(double t, double slope, double curvature,
                const std::vector<std::pair<ClippedSpring, double>>& springs) {
  double sum = slope + curvature * t;
  for (const auto& [spring, rate] : springs)
    sum -= std::clamp(spring.force - spring.stiffness * rate * t, spring.low, spring.high) * rate;
  return sum;
}

}  // namespace

TEST(LineSearch, FindsWhereTheDerivativeVanishes) {
  std::mt19937 random(3);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  LineSearch search;
  int searched = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    search.clear();
    std::vector<std::pair<ClippedSpring, double>> springs;
    for (int k = trial % 8; k > 0; --k) {
      const double low = k == 2 ? 0 : uniform(-2, 0);
      const double high = k == 2 ? std::numeric_limits<double>::infinity() : k == 3 ? low : uniform(0, 2);
      const ClippedSpring spring{uniform(-5, 5), std::exp(uniform(-3, 5)), low, high};
      springs.emplace_back(spring, uniform(-1, 1));
      search.add(spring, springs.back().second);
    }
    const double slope = uniform(-10, -1), curvature = std::exp(uniform(-3, 3));
    if (slope_at(0, slope, curvature, springs) >= 0) continue;
    ++searched;
    const double t = search.find_minimum(slope, curvature);
    EXPECT_GT(t, 0);
    EXPECT_NEAR(slope_at(t, slope, curvature, springs), 0, 1e-10) << trial;
  }
  EXPECT_GT(searched, 1000);
}

TEST(LineSearch, WithoutSpringsIsNewtonsStep) {
  LineSearch search;
  EXPECT_DOUBLE_EQ(search.find_minimum(-3, 4), 0.75);
  search.add({0, 1e9, 0, 1e9}, 1);  // pushes back at once
  EXPECT_LT(search.find_minimum(-3, 4), 1);
  search.add({1, 2, -1, 1}, 1);
  search.clear();
  EXPECT_DOUBLE_EQ(search.find_minimum(-3, 4), 0.75);
}

/// Without a quadratic a spring at its bound lets the potential fall for ever.
TEST(LineSearch, GoesBeyondAllChangesWhereThePotentialFallsForEver) {
  LineSearch search;
  search.add({0.5, 0.25, -1, 1}, 1);  // at its lower bound from t = 6 on
  const double t = search.find_minimum(-2, 0);
  EXPECT_GT(t, 6);
  EXPECT_TRUE(std::isfinite(t));
}
