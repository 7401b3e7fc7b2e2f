// Gap and slip of rounded corners against their definitions, and the properties that forces need.
#include <ddacontact/contact/rounded_motion.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

using namespace ddacontact;

namespace {

constexpr std::array<Vec2 RoundedPositions::*, 4> positions{&RoundedPositions::i, &RoundedPositions::j,
                                                            &RoundedPositions::k, &RoundedPositions::after_i};
constexpr std::array<Vec2 VertexEdgeGradient::*, 4> gradients{
    &VertexEdgeGradient::i, &VertexEdgeGradient::j, &VertexEdgeGradient::k, &VertexEdgeGradient::after_i};
constexpr double lock = 0.3;

RoundedPositions zero() {
  return {{Vec2::Zero(), Vec2::Zero(), Vec2::Zero()}, Vec2::Zero()};
}
double along(const VertexEdgeGradient& gradient, const RoundedPositions& by) {
  double sum = 0;
  for (int p = 0; p < 4; ++p) sum += (gradient.*gradients[p]).dot(by.*positions[p]);
  return sum;
}

/// A vertex above an edge or near its start.
struct RoundedMotion : testing::TestWithParam<bool> {
  std::mt19937 random{3};
  RoundedPositions start = zero();
  Rounding rounding;

  Vec2 any(double size) {
    return {support::uniform(-size, size, random), support::uniform(-size, size, random)};
  }
  RoundedPositions any_motion(double size) { return {{any(size), any(size), any(size)}, any(size)}; }
  void put_at_random() {
    start = {{Vec2(0.3, 0.5) + any(0.2), Vec2(0, 0) + any(0.1), Vec2(1, 0) + any(0.1)},
             Vec2(1.2, 1) + any(0.2)};
    rounding = {.centre = {0.1, 0.1}, .surface = {0.02, 0.05}, .radius = 0.1, .corner = GetParam()};
    if (rounding.corner) {
      rounding.start = {-0.4, -0.3};
      rounding.end = {0.5, -0.1};
      rounding.other_centre = {0.05, -0.2};
    }
  }
  GapAndSlip at(const RoundedPositions& by, Directions directions = Directions::of_end) const {
    return gap_and_slip(start, by, lock, directions, rounding);
  }
};

TEST_P(RoundedMotion, GapIsTheDistanceLessTheRadius) {
  put_at_random();
  const RoundedPositions by = any_motion(0.1);
  const Vec2 i = start.i + by.i, j = start.j + by.j, k = start.k + by.k, next = start.after_i + by.after_i,
             centre = rounding.centre.at(i, next);
  const Vec2 t = (k - j).normalized();
  const Vec2 other = rounding.other_centre.at(j, k);
  const double distance = GetParam() ? (centre - other).norm() : cross(centre - j, t);
  EXPECT_NEAR(at(by).gap, distance - 0.1, 1e-14);
}

TEST_P(RoundedMotion, GradientsAreDerivatives) {
  for (int trial = 0; trial < 20; ++trial) {
    put_at_random();
    const RoundedPositions by = any_motion(0.1);
    const GapAndSlip here = at(by);
    for (auto p : positions)
      for (int axis : {0, 1}) {
        RoundedPositions direction = zero(), before = by, after = by;
        (direction.*p)[axis] = 1;
        const double h = 1e-6;
        (before.*p)[axis] -= h;
        (after.*p)[axis] += h;
        EXPECT_NEAR(along(here.by_gap, direction), (at(after).gap - at(before).gap) / (2 * h), 1e-8);
        EXPECT_NEAR(along(here.by_slip, direction), (at(after).slip - at(before).slip) / (2 * h), 1e-8);
      }
  }
}

TEST_P(RoundedMotion, MeanGradientsDoTheWorkOfTheChange) {
  for (int trial = 0; trial < 20; ++trial) {
    put_at_random();
    const RoundedPositions by = any_motion(0.3);
    const GapAndSlip none = at(zero()), mean = at(by, Directions::mean);
    EXPECT_NEAR(along(mean.by_gap, by), mean.gap - none.gap, 1e-14);
    EXPECT_NEAR(along(mean.by_slip, by), mean.slip - none.slip, 1e-14);
  }
}

TEST_P(RoundedMotion, ForcesHaveNeitherSumNorMoment) {
  for (int trial = 0; trial < 20; ++trial) {
    put_at_random();
    const RoundedPositions by = any_motion(0.1);
    const GapAndSlip here = at(by);
    for (const VertexEdgeGradient* gradient : {&here.by_gap, &here.by_slip}) {
      Vec2 sum = Vec2::Zero();
      double moment = 0;
      for (int p = 0; p < 4; ++p) {
        const Vec2 force = gradient->*gradients[p];
        sum += force;
        moment += cross(start.*positions[p] + by.*positions[p], force);
      }
      EXPECT_LE(sum.norm(), 1e-14);
      EXPECT_LE(std::abs(moment), 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EdgeAndCorner, RoundedMotion, testing::Bool());

}  // namespace
