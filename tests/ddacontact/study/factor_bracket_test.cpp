#include <ddacontact/study/factor_bracket.hpp>

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace ddacontact;

/// Rests up to a factor; keeps what was asked.
struct Slope {
  double factor;
  std::vector<double> asked;

  FactorBracket search(const std::optional<FactorRange>& range, double tolerance = 1e-3) {
    return bracket_factor(
        [this](double f) {
          asked.push_back(f);
          return f <= factor ? Verdict::rests : Verdict::moves;
        },
        range, tolerance);
  }
};

TEST(FactorBracket, HoldsTheFactorWithinTheTolerance) {
  for (const double factor : {0.13, 0.4, 1.0, 1.001, 3.7, 99.0}) {
    Slope slope{factor, {}};
    const FactorBracket bracket = slope.search(std::nullopt);
    EXPECT_LE(bracket.low, factor);
    EXPECT_GT(bracket.high, factor);
    EXPECT_LE(bracket.high - bracket.low, 1e-3 * bracket.low);
  }
}

TEST(FactorBracket, SaysWhenNoFactorMovesOrRests) {
  Slope always_rests{1e9, {}}, always_moves{0, {}};
  const FactorBracket rests = always_rests.search(std::nullopt), moves = always_moves.search(std::nullopt);
  EXPECT_FALSE(rests.closed());
  EXPECT_GE(rests.low, widest_range.high);
  EXPECT_FALSE(moves.closed());
  EXPECT_EQ(moves.low, 0);
  EXPECT_LE(moves.high, widest_range.low);
}

TEST(FactorBracket, StaysInTheRange) {
  Slope inside{1.3, {}}, below{0.5, {}}, above{5, {}};
  EXPECT_TRUE(inside.search(FactorRange{1, 2}).closed());
  for (const double f : inside.asked) EXPECT_TRUE(f >= 1 && f <= 2) << f;
  EXPECT_EQ(below.search(FactorRange{1, 2}).high, 1);
  EXPECT_EQ(below.asked, std::vector<double>{1});
  EXPECT_EQ(above.search(FactorRange{1, 2}).low, 2);
}

/// Stops where `stops` says so; rests up to 1.2.
FactorBracket search_with_stops(const std::function<bool(double)>& stops, int& n) {
  n = 0;
  return bracket_factor(
      [&](double f) {
        ++n;
        return stops(f) ? Verdict::stopped : f <= 1.2 ? Verdict::rests : Verdict::moves;
      },
      std::nullopt, 1e-3);
}

TEST(FactorBracket, PassesATrialThatStops) {
  for (const double at : {1.0, 1.5, 1.25}) {
    int n = 0;
    const FactorBracket bracket = search_with_stops([&](double f) { return f == at; }, n);
    EXPECT_FALSE(bracket.stopped);
    EXPECT_LE(bracket.low, 1.2);
    EXPECT_GT(bracket.high, 1.2);
    EXPECT_LE(bracket.high - bracket.low, 1e-3 * bracket.low);
  }
}

TEST(FactorBracket, EndsWhereAllTrialsStop) {
  int n = 0;
  const FactorBracket bracket = search_with_stops([](double f) { return f > 1 && f < 1.5; }, n);
  EXPECT_TRUE(bracket.stopped);
  EXPECT_EQ(n, 5);  // 1, 1.5, the middle, the thirds
  EXPECT_EQ(bracket.low, 1);
  EXPECT_EQ(bracket.high, 1.5);
}

}  // namespace
