#include <ddacontact/core/time_function.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using namespace ddacontact;
using Kind = TimeFunction::Kind;

TEST(TimeFunction, ConstantDoesNotKnowTheTime) {
  const TimeFunction f{Kind::constant, {1, -2}, {}};
  for (double t : {-1., 0., 3., 1e9}) EXPECT_EQ(f.at(t, 2), Vec2(1, -2));
}

TEST(TimeFunction, RampIsLinearToTheEndAndThenStays) {
  const TimeFunction f{Kind::ramp, {1, -2}, {}};
  EXPECT_EQ(f.at(0, 8), Vec2(0, 0));
  EXPECT_EQ(f.at(2, 8), Vec2(0.25, -0.5));
  EXPECT_EQ(f.at(8, 8), Vec2(1, -2));
  EXPECT_EQ(f.at(80, 8), Vec2(1, -2));
}

TEST(TimeFunction, RateIsProportionalToTimeWithoutEnd) {
  const TimeFunction f{Kind::rate, {1, -2}, {}};
  EXPECT_EQ(f.at(0, 2), Vec2(0, 0));
  EXPECT_EQ(f.at(16, 2), Vec2(16, -32));
}

TEST(TimeFunction, HistoryMeetsItsEntriesIsLinearBetweenAndConstantOutside) {
  const TimeFunction f{Kind::history, {0, 0}, {{1, 10, 0}, {2, 20, 8}, {4, 0, -8}}};
  EXPECT_EQ(f.at(0, 9), Vec2(10, 0));
  EXPECT_EQ(f.at(1, 9), Vec2(10, 0));
  EXPECT_EQ(f.at(1.25, 9), Vec2(12.5, 2));
  EXPECT_EQ(f.at(2, 9), Vec2(20, 8));
  EXPECT_EQ(f.at(3, 9), Vec2(10, 0));
  EXPECT_EQ(f.at(4, 9), Vec2(0, -8));
  EXPECT_EQ(f.at(5, 9), Vec2(0, -8));
}

/// Every kind but the constant counts from its beginning on, a ramp the whole of its way to the end.
TEST(TimeFunction, CountsFromItsBeginning) {
  TimeFunction ramp{Kind::ramp, {1, -2}, {}}, rate{Kind::rate, {1, -2}, {}},
      history{Kind::history, {0, 0}, {{1, 10, 0}, {2, 20, 8}, {4, 0, -8}}};
  for (TimeFunction* f : {&ramp, &rate, &history}) {
    f->begin(2, 10);
    EXPECT_EQ(f->at(2, 10), Vec2(0, 0));
  }
  EXPECT_EQ(ramp.at(6, 10), Vec2(0.5, -1));
  EXPECT_EQ(ramp.at(10, 10), Vec2(1, -2));
  EXPECT_EQ(rate.at(5, 10), Vec2(3, -6));
  EXPECT_EQ(history.at(3, 10), Vec2(-10, -8));
}

/// Whatever lies between the ends of a span: a pulse, a jump, the start of a ramp.
TEST(TimeFunction, MeansAreIntegrals) {
  const TimeFunction pulse{Kind::history, {0, 0}, {{0.003, 0, 0}, {0.004, 100, -50}, {0.005, 0, 0}}},
      jump{Kind::history, {0, 0}, {{0, 2, 0}, {0.25, 2, 0}, {0.25, 6, 0}, {1, 6, 0}}},
      ramp{Kind::ramp, {8, 0}, {}, {}, 0, 1};
  EXPECT_NEAR((pulse.mean({0, 0.01}, 1) - Vec2(10, -5)).norm(), 0, 1e-13);
  EXPECT_NEAR((pulse.mean({0.0035, 0.0045}, 1) - Vec2(75, -37.5)).norm(), 0, 1e-12);
  EXPECT_NEAR(jump.mean({0, 1}, 1).x(), 5, 1e-14);
  EXPECT_NEAR(ramp.mean({0, 2}, 3).x(), 1, 1e-14);
  EXPECT_EQ(jump.mean({0.5, 0.5}, 1), Vec2(6, 0));
  EXPECT_NEAR(jump.mean({0.125, 0.25}, 1).x(), 2, 1e-14) << "the jump comes later";
  EXPECT_NEAR(jump.mean({0.25, 0.5}, 1).x(), 6, 1e-14);
  TimeFunction rising = jump;  // by the way of all other functions
  rising.rise = 0.5;
  EXPECT_NEAR(rising.mean({0, 1}, 1).x(), 0.125 + 2.25 / 2 + 3, 1e-13);
  EXPECT_NEAR(rising.mean({0.5, 1}, 1).x(), 6, 1e-14);
  EXPECT_EQ(zero_outside(jump).at(2, 1), Vec2(0, 0));
  EXPECT_EQ(zero_outside(jump).at(1, 1), Vec2(6, 0)) << "the end is not outside";
  EXPECT_NEAR(zero_outside(jump).mean({-1, 1}, 1).x(), 2.5, 1e-14);
}

TEST(TimeFunction, RatesAtTheStartAreExactForEvenAcceleration) {
  const TimeFunction rate{Kind::rate, {1, -2}, {}},
      accelerated = history_function(Kind::acceleration_history, {{0, 3, 0}, {1, 3, 0}});
  EXPECT_NEAR((rate.rate_at_start(0.01, 9) - Vec2(1, -2)).norm(), 0, 1e-14);
  EXPECT_NEAR(accelerated.rate_at_start(0.01, 9).norm(), 0, 1e-14);
}

TEST(TimeFunction, HistoryOfOneEntryIsConstant) {
  const TimeFunction f{Kind::history, {0, 0}, {{1, 3, 4}}};
  for (double t : {0., 1., 2.}) EXPECT_EQ(f.at(t, 9), Vec2(3, 4));
}

/// Two entries at one time are a jump, whose later value holds from then on.
TEST(TimeFunction, HistoryMayJump) {
  const TimeFunction f{Kind::history, {0, 0}, {{0, 0, 0}, {1, 0, 0}, {1, 5, 5}, {2, 5, 5}}};
  EXPECT_EQ(f.at(0.999, 9), Vec2(0, 0));
  EXPECT_EQ(f.at(1, 9), Vec2(5, 5));
  EXPECT_EQ(f.at(1.001, 9), Vec2(5, 5));
}

TEST(TimeFunction, HistoryOfAVelocityIsItsIntegral) {
  const TimeFunction f = history_function(Kind::velocity_history, {{1, 0, 2}, {2, 4, 2}, {4, 4, -2}});
  EXPECT_EQ(f.at(0, 9), Vec2(0, 0));
  EXPECT_EQ(f.at(1, 9), Vec2(0, 0));
  EXPECT_NEAR((f.at(1.5, 9) - Vec2(0.5, 1)).norm(), 0, 1e-15);
  EXPECT_NEAR((f.at(2, 9) - Vec2(2, 2)).norm(), 0, 1e-15);
  EXPECT_NEAR((f.at(3, 9) - Vec2(6, 3)).norm(), 0, 1e-15);
  EXPECT_NEAR((f.at(5, 9) - Vec2(14, 0)).norm(), 0, 1e-15);  // on with (4, -2)
}

TEST(TimeFunction, HistoryOfAnAccelerationIsItsDoubleIntegral) {
  const TimeFunction f = history_function(Kind::acceleration_history, {{1, 6, 0}, {2, 12, 6}, {3, 0, 0}});
  EXPECT_EQ(f.at(0.5, 9), Vec2(0, 0));
  // a = 6 + 6 s: v = 6 s + 3 s^2, u = 3 s^2 + s^3; then a = 12 - 12 s: v = 9 + 12 s - 6 s^2.
  EXPECT_NEAR((f.at(1.5, 9) - Vec2(0.875, 0.125)).norm(), 0, 1e-15);
  EXPECT_NEAR((f.at(2, 9) - Vec2(4, 1)).norm(), 0, 1e-14);
  EXPECT_NEAR((f.at(2.5, 9) - Vec2(4 + 4.5 + 1.5 - 0.25, 1 + 1.5 + 0.75 - 0.125)).norm(), 0, 1e-14);
  EXPECT_NEAR((f.at(3, 9) - Vec2(17, 6)).norm(), 0, 1e-14);
  EXPECT_NEAR((f.at(4, 9) - Vec2(17 + 15, 6 + 6)).norm(), 0, 1e-14);
}

/// Records end in zeros, and loads stay: what only goes on does not change.
TEST(TimeFunction, LastChangeIsWhereTheRestBegins) {
  const std::vector<Vec3> tail{{0, 0, 0}, {1, 3, 4}, {2, 0, 0}, {5, 0, 0}, {9, 0, 0}};
  EXPECT_EQ(history_function(Kind::history, tail).last_change(20), 2);
  EXPECT_EQ(history_function(Kind::velocity_history, tail).last_change(20), 2);
  EXPECT_EQ(history_function(Kind::history, {{0, 0, 0}, {1, 3, 4}, {2, 3, 4}}).last_change(20), 1);
  EXPECT_EQ(history_function(Kind::velocity_history, {{0, 0, 0}, {1, 3, 4}, {2, 3, 4}}).last_change(20), 2);
}

/// Of a smooth motion at rest at both ends a spline is accurate to fourth order, its velocity to third.
TEST(TimeFunction, SmoothHistoryConvergesToTheMotionThatWasSampled) {
  const auto motion = [](double t) { return std::pow(std::sin(t), 4); };
  double before = 0;
  for (const int n : {20, 40, 80}) {
    std::vector<Vec3> entries;
    for (int k = 0; k <= n; ++k)
      entries.emplace_back(std::numbers::pi * k / n, motion(std::numbers::pi * k / n), 0);
    const TimeFunction f = history_function(Kind::smooth_history, entries);
    double error = 0;
    for (double t = 0; t < std::numbers::pi; t += 0.01)
      error = std::max(error, std::abs(f.at(t, 9).x() - motion(t)));
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / error), 4, 0.4) << n;
    }
    before = error;
  }
}

TEST(TimeFunction, SamplingErrorOfASineIsThatOfItsCurvature) {
  for (const int per_period : {8, 16, 32}) {
    std::vector<Vec3> entries;
    for (int k = 0; k <= 20 * per_period; ++k)
      entries.emplace_back(k, std::sin(2 * std::numbers::pi * k / per_period), 0);
    const double expected = std::pow(2 * std::numbers::pi / per_period, 2) / 8;
    EXPECT_NEAR(ddacontact::sampling_error(entries), expected, 0.15 * expected) << per_period;
  }
}

TEST(TimeFunction, RisesFromNothing) {
  TimeFunction f{Kind::constant, {8, -4}, {}};
  f.rise = 2;
  EXPECT_EQ(f.at(0, 9), Vec2(0, 0));
  EXPECT_EQ(f.at(0.5, 9), Vec2(2, -1));
  EXPECT_EQ(f.at(3, 9), Vec2(8, -4));
}

namespace {

constexpr double interval = 0.25;

/// Given at multiples of the interval, y twice as much as x.
TimeFunction at_intervals(const std::vector<double>& x) {
  TimeFunction function{TimeFunction::Kind::history, {0, 0}, {}};
  for (std::size_t k = 0; k < x.size(); ++k)
    function.history.emplace_back(interval * static_cast<double>(k), x[k], 2 * x[k]);
  return function;
}

}  // namespace

/// Exact for a parabola.
TEST(RateOfATimeFunction, IsTheMeanOfTheStepsOnBothSidesWhereItIsSmooth) {
  std::vector<double> parabola;
  for (int k = 0; k < 9; ++k) parabola.push_back(k * interval * k * interval);
  for (int k = 2; k < 7; ++k)
    for (const int axis : {0, 1})
      EXPECT_NEAR(at_intervals(parabola).rate(axis, k * interval, interval, 9), (1 + axis) * 2 * k * interval,
                  1e-12);
}

/// At rest to the third time, then at a velocity of 4: what it had before it jumped.
TEST(RateOfATimeFunction, WhereItJumpsIsThatBefore) {
  for (const double way : {-1., 1.}) {
    const TimeFunction starts = at_intervals({0, 0, 0, 0, way, 2 * way, 3 * way, 4 * way}),
                       stops = at_intervals({0, way, 2 * way, 3 * way, 3 * way, 3 * way, 3 * way});
    EXPECT_EQ(starts.rate(0, 3 * interval, interval, 9), 0);
    EXPECT_NEAR(starts.rate(0, 4 * interval, interval, 9), 4 * way, 1e-12) << "and then what it has";
    EXPECT_NEAR(stops.rate(0, 3 * interval, interval, 9), 4 * way, 1e-12);
  }
}
