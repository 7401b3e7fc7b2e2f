#include <tests/performance/error_time/comparison.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace error_time;

Measurement of(const Problem& problem, const std::string& method, double setting, std::size_t quantity = 0) {
  return measure(problem, problem.judge(), method_of(method), setting, false)[quantity];
}

double error(const Problem& problem, const std::string& method, double setting, std::size_t quantity = 0) {
  const Measurement made = of(problem, method, setting, quantity);
  EXPECT_EQ(made.stopped, "") << problem.name << ", " << method;
  return made.error;
}

class EveryMethod : public testing::TestWithParam<std::string> {};

TEST_P(EveryMethod, AnalysesTheCheapestOfEveryQuickProblem) {
  for (const Problem& problem : {sliding(), colliding(), wave(), sliding_slope()})
    EXPECT_LT(error(problem, GetParam(), problem.settings.front()), 1) << problem.name;
}
INSTANTIATE_TEST_SUITE_P(ErrorTime, EveryMethod,
                         testing::Values("default", "classic", "paper", "midpoint", "dda", "backward_euler",
                                         "affine", "wachspress", "mesh", "tolerance 1e-4", "tolerance 1e-8",
                                         "explicit", "contacts to 1e-3"));

/// The reference takes long.
TEST(ErrorTime, TheSlopeIsAnalysedByTheMethodsThatMatterMost) {
  const Judge unjudged = [](const ddacontact::Stepper&) { return std::vector{0.}; };
  const Problem problem = resting_slope();
  for (const std::string method : {"default", "classic", "paper"})
    EXPECT_EQ(measure(problem, unjudged, method_of(method), problem.settings.front(), false)[0].stopped, "")
        << method;
}

TEST(ErrorTime, TheDefaultBendsAnArchAndHasNoSpringsInIt) {
  const Problem problem = arch();
  const Judge judge = problem.judge();
  const auto error = [&](const std::string& method) {
    return measure(problem, judge, method_of(method), 4, false)[0].error;
  };
  const double found = error("default");
  EXPECT_LT(error("mesh"), found);
  EXPECT_LT(found, 0.5 * error("paper"));
  EXPECT_LT(found, 0.5 * error("classic"));
}

/// Steps take the whole impulse of a force that sways: what is left is that of the lines of its history.
TEST(ErrorTime, TheDefaultSlidesAsTheForceHasItInAnyStep) {
  for (const double time_step : {0.02, 0.01})
    EXPECT_LT(error(sliding(), "default", time_step), 1e-6) << time_step;
  EXPECT_GT(error(sliding(), "classic", 0.02), 1e-5);
}

TEST(ErrorTime, BlocksThatSlideAsOneComeAsFarAsOne) {
  for (const double time_step : {0.02, 0.01})
    EXPECT_LT(error(sliding_slope(), "default", time_step), 1e-6) << time_step;
}

TEST(ErrorTime, TheDefaultKnowsWhatACollisionMakes) {
  EXPECT_LT(error(colliding(), "default", 0.02), 1e-4);
  EXPECT_GT(error(colliding(), "classic", 0.001), 0.1);
}

TEST(ErrorTime, FrontsOfWavesAreWhereTheyShouldBe) {
  EXPECT_LT(error(wave(), "default", 24), error(wave(), "classic", 24));
  EXPECT_LT(error(wave(), "midpoint", 24, 1), 0.8 * error(wave(), "default", 24, 1));
}

Measurement made(double seconds, double error, const std::string& method) {
  return {.problem = "p", .quantity = "q", .method = method, .seconds = seconds, .error = error};
}

TEST(ErrorTime, AFrontierLeavesOutRunsThatBuyNothing) {
  const Frontier found = frontier(
      {made(4, 1e-3, "a"), made(1, 1e-1, "a"), made(2, 0.5, "a"), made(8, NAN, "a"), made(1, 1e-9, "b")}, "q",
      "a");
  EXPECT_EQ(found.seconds, (std::vector<double>{1, 4}));
  EXPECT_EQ(found.errors, (std::vector<double>{1e-1, 1e-3}));
  EXPECT_NEAR(found.error_at(2), 1e-2, 1e-12);
  EXPECT_EQ(found.error_at(100), 1e-3);
}

TEST(ErrorTime, LeadsAreThoseAtEqualRunTime) {
  const std::vector<Measurement> all{made(1, 1e-1, "a"), made(100, 1e-3, "a"), made(10, 1e-1, "b"),
                                     made(1000, 1e-5, "b")};
  const auto lead = lead_of(frontier(all, "q", "a"), frontier(all, "q", "b"));
  ASSERT_TRUE(lead);
  EXPECT_NEAR(lead->most, 10, 1e-9);
  EXPECT_EQ(lead->most_at, 10);
  EXPECT_NEAR(lead->least, 1e-2, 1e-9);
  EXPECT_EQ(lead->least_at, 1000);
}

TEST(ErrorTime, RunsThatDoNotEndAreWrong) {
  EXPECT_EQ(frontier({made(1, NAN, "a")}, "q", "a").errors, std::vector<double>{1});
}

}  // namespace
