#include <ddacontact/solver/line_search.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

using namespace ddacontact;

namespace {

/// Derivative of the potential along the line, from its definition.
double slope_at(double t, double slope, double curvature, std::span<const LineSpring> springs) {
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
  int searched = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<LineSpring> springs;
    for (int k = trial % 8; k > 0; --k) {
      const double low = k == 2 ? 0 : uniform(-2, 0);
      const double high = k == 2 ? std::numeric_limits<double>::infinity() : k == 3 ? low : uniform(0, 2);
      const ClippedSpring spring{uniform(-5, 5), std::exp(uniform(-3, 5)), low, high};
      springs.push_back({spring, uniform(-1, 1)});
    }
    const double slope = uniform(-10, -1), curvature = std::exp(uniform(-3, 3));
    if (slope_at(0, slope, curvature, springs) >= 0) continue;
    ++searched;
    const double t = minimum_along(springs, slope, curvature);
    EXPECT_GT(t, 0);
    EXPECT_NEAR(slope_at(t, slope, curvature, springs), 0, 1e-10) << trial;
  }
  EXPECT_GT(searched, 1000);
}

TEST(LineSearch, WithoutSpringsIsNewtonsStep) {
  EXPECT_DOUBLE_EQ(minimum_along({}, -3, 4), 0.75);
  const LineSpring at_once{{0, 1e9, 0, 1e9}, 1};
  EXPECT_LT(minimum_along(std::array{at_once}, -3, 4), 1);
}

/// Without a quadratic a spring at its bound lets the potential fall for ever.
TEST(LineSearch, GoesBeyondAllChangesWhereThePotentialFallsForEver) {
  const LineSpring at_its_lower_bound_from_6{{0.5, 0.25, -1, 1}, 1};
  const double t = minimum_along(std::array{at_its_lower_bound_from_6}, -2, 0);
  EXPECT_GT(t, 6);
  EXPECT_TRUE(std::isfinite(t));
}
