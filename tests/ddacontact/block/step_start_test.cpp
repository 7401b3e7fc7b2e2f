/// \file The time schemes' numbers: uniform acceleration, the times of loads, and static steps.
#include <ddacontact/block/step_start.hpp>

#include <gtest/gtest.h>

#include <utility>

using namespace ddacontact;

namespace {

constexpr Scheme all_schemes[] = {Scheme::decaying, Scheme::central_difference, Scheme::midpoint, Scheme::dda,
                                  Scheme::newmark,  Scheme::backward_euler};

AnalysisOptions options(Scheme scheme, Mode mode = Mode::dynamic) {
  AnalysisOptions analysis;
  analysis.scheme = scheme;
  analysis.mode = mode;
  analysis.beta = 0.3;
  analysis.gamma = 0.6;
  return analysis;
}

}  // namespace

/// A point of unit mass under a constant force of 3 N: by displacements that are exact the inertia force is
/// the force. With half steps the velocity is that in the middle of the step before, of another length.
TEST(StepRule, UniformAccelerationIsExact) {
  const double a = 3, v = 2, dt = 0.1, before = 0.04;
  for (const Scheme scheme :
       {Scheme::decaying, Scheme::central_difference, Scheme::midpoint, Scheme::dda, Scheme::newmark}) {
    const StepRule rule = step_rule(options(scheme), dt, before);
    const double v0 = rule.has_half_steps() ? v - a * before / 2 : v, d = dt * v + a * dt * dt / 2;
    EXPECT_NEAR(rule.inertia() * (d - dt * v0) / (dt * dt) - rule.history() * a, a, 1e-12)
        << static_cast<int>(scheme);
  }
  // Backward Euler goes on with the velocity of the end, v + a dt.
  const StepRule rule = step_rule(options(Scheme::backward_euler), dt, before);
  EXPECT_NEAR(rule.inertia() * (dt * (v + a * dt) - dt * v) / (dt * dt), a, 1e-12);
}

/// Steps of different lengths: where the time of one step's loads ends that of the next begins. The others
/// take them at the end.
TEST(StepRule, TimesOfLoadsLeaveNoGapBetweenSteps) {
  for (const Scheme scheme : all_schemes) {
    const StepRule first = step_rule(options(scheme), 0.1, 0.04), next = step_rule(options(scheme), 0.3, 0.1);
    const TimeSpan of_first = first.load_span(2, 0.1), of_next = next.load_span(2.1, 0.3);
    if (first.has_half_steps() || first.mean_forces())
      EXPECT_NEAR(of_next.from, of_first.to, 1e-14);
    else
      EXPECT_EQ(of_next.from, 2.1 + 0.3);
    EXPECT_NEAR(of_next.to, first.has_half_steps() ? 2.1 + 0.15 : 2.4, 1e-14);
  }
  // The first step of a run: half of it.
  EXPECT_NEAR(step_rule(options(Scheme::decaying), 0.1, 0).load_span(0, 0.1).from, 0, 1e-17);
}

/// They start from rest and end in equilibrium with the loads of their end.
TEST(StepRule, StaticStepsAreThoseOfSchemesThatComeToRest) {
  for (const Scheme scheme : all_schemes) {
    const StepRule rule = step_rule(options(scheme, Mode::statics), 0.1, 0.04);
    EXPECT_TRUE(rule.starts_at_rest);
    EXPECT_FALSE(rule.mean_forces() || rule.is_explicit() || rule.predicts_shape());
    EXPECT_EQ(rule.impulse_time, 1);
    const TimeSpan loads = rule.load_span(2, 0.1);
    EXPECT_EQ(loads.from, 2.1);
    EXPECT_EQ(loads.to, 2.1);
  }
  EXPECT_EQ(step_rule(options(Scheme::midpoint, Mode::statics), 1, 1).scheme, Scheme::backward_euler);
  EXPECT_EQ(step_rule(options(Scheme::central_difference, Mode::statics), 1, 1).scheme, Scheme::decaying);
}

TEST(StepRule, OptionsOfNewmarkAreThoseOfNewmarkAlone) {
  for (const Scheme scheme : all_schemes) {
    AnalysisOptions analysis = options(scheme);
    analysis.damping = {.mass = 7, .stiffness = 0.1};
    const StepRule rule = step_rule(analysis, 0.1, 0.1);
    EXPECT_EQ(rule.beta, scheme == Scheme::newmark ? 0.3 : 0.5);
    EXPECT_EQ(rule.gamma, scheme == Scheme::newmark ? 0.6 : 1);
    EXPECT_EQ(rule.damping.mass, 7);
    EXPECT_EQ(rule.damping.stiffness, 0.1);
    EXPECT_EQ(rule.history() != 0, scheme == Scheme::newmark);
  }
}
