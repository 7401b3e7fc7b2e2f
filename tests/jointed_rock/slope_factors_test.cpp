// Factors of safety of a few random slopes against limit analysis; doc/verification/jointed_rock.md has 50.
#include "slope_factors.hpp"
#include "sudden_weight.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace jointed_rock;

constexpr support::SlopeSize size{20, 40};

Slope slope_of(std::uint64_t seed) {
  Slopes slopes(size);
  Slope slope = slopes.next();
  while (slope.seed != seed) slope = slopes.next();
  return slope;
}

class SlopeFactors : public testing::TestWithParam<std::uint64_t> {};

TEST_P(SlopeFactors, NoSlopeRestsWhereNoAdmissibleForcesExist) {
  const Slope slope = slope_of(GetParam());
  const StrengthReduction reduction = reduction_of(slope);
  EXPECT_EQ(reduction.unsettled(), "");
  const StrengthTrial trial = reduction.try_factor(most_above * interlocked_factor(slope) * known_factor);
  EXPECT_EQ(trial.verdict, ddacontact::Verdict::moves);
  if (!slid_on_a_plane(slope, trial)) return;
  EXPECT_EQ(reduction.try_factor(least_on_a_plane * known_factor).verdict, ddacontact::Verdict::rests);
}

/// Planes, several planes, blocks whose corners interlock.
INSTANTIATE_TEST_SUITE_P(Seeds, SlopeFactors, testing::Values(3, 5, 12, 23, 37, 43, 44));

/// Corners that meet at a crossing hold nothing, though admissible forces between them would: rounded ones move no
/// earlier.
TEST(SlopeFactors, CornersThatMeetAtACrossingHoldNothing) {
  for (const std::uint64_t seed : {21, 44}) {
    const Slope slope = slope_of(seed);
    const SlopeFactor factor = factor_of(slope, 0.01);
    EXPECT_GT(factor.interlocked, 1.05) << seed;
    EXPECT_LE(factor.found.low, most_above) << seed;
    EXPECT_EQ(rounded_trial(slope, factor).verdict, ddacontact::Verdict::rests) << seed;
  }
}

/// Where the friction of a contact that slid followed its bound there was no solution at 52 to 80 degrees.
TEST(SlopeFactors, SlopesWithMoreFrictionThanHoldsThemRest) {
  Slopes slopes({20, 60});
  for (const std::uint64_t seed : {68, 98, 101, 115, 153, 179}) {
    Slope slope = slopes.next();
    while (slope.seed != seed) slope = slopes.next();
    const Outcome outcome = let_go(slope.scene, above_both * std::max(slope.limit, slope.steepest),
                                   least_acceleration(slope.limit));
    EXPECT_EQ(outcome.verdict, jointed_rock::Verdict::rests) << seed;
  }
}

/// With so much friction sweeps may diverge; the step is then solved from where it was.
TEST(SlopeFactors, ASlopeInWhichSweepsDivergeRests) {
  constexpr double limit = 0.726112916, steepest = 2.03059741;
  const Outcome outcome =
      let_go(support::random_slope(59, {20, 60}), above_both * steepest, least_acceleration(limit));
  EXPECT_EQ(outcome.verdict, jointed_rock::Verdict::rests);
}

}  // namespace
