#include <ddacontact/time/support_velocity.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

constexpr double interval = 0.25;

/// A support whose x is given at multiples of the interval, and y twice as much.
PrescribedDof moved_by(const std::vector<double>& x, int axis) {
  PrescribedDof held;
  held.axis = axis;
  held.motion.kind = TimeFunction::Kind::history;
  for (std::size_t k = 0; k < x.size(); ++k)
    held.motion.history.emplace_back(interval * static_cast<double>(k), x[k], 2 * x[k]);
  return held;
}

}  // namespace

TEST(SupportVelocity, OfASmoothMotionIsTheMeanOfTheStepsOnBothSides) {
  std::vector<double> parabola;
  for (int k = 0; k < 9; ++k) parabola.push_back(k * interval * k * interval);
  for (int k = 2; k < 7; ++k) {  // exact for a parabola: 2 t
    EXPECT_NEAR(support_velocity(moved_by(parabola, 0), k * interval, interval, 9), 2 * k * interval, 1e-12);
    EXPECT_NEAR(support_velocity(moved_by(parabola, 1), k * interval, interval, 9), 4 * k * interval, 1e-12);
  }
}

/// At rest to the third time, then at a velocity of 4: what it had before it jumped.
TEST(SupportVelocity, WhereItJumpsIsThatBefore) {
  for (const double way : {-1., 1.}) {
    const PrescribedDof starts = moved_by({0, 0, 0, 0, way, 2 * way, 3 * way, 4 * way}, 0);
    EXPECT_EQ(support_velocity(starts, 3 * interval, interval, 9), 0);
    EXPECT_NEAR(support_velocity(starts, 4 * interval, interval, 9), 4 * way, 1e-12)
        << "and then what it has";
    const PrescribedDof stops = moved_by({0, way, 2 * way, 3 * way, 3 * way, 3 * way, 3 * way}, 0);
    EXPECT_NEAR(support_velocity(stops, 3 * interval, interval, 9), 4 * way, 1e-12);
  }
}
