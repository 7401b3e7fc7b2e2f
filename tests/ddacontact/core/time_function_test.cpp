#include <ddacontact/core/time_function.hpp>

#include <gtest/gtest.h>

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
