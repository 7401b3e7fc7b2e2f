#include <ddacontact/study/trials_ahead.hpp>

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace {

using namespace ddacontact;

constexpr double tolerance = 0.005;

Verdict verdict_at(double factor, double limit) {
  return factor <= limit ? Verdict::rests : Verdict::moves;
}

StrengthTrial trial_of(double factor, Verdict verdict) {
  StrengthTrial trial;
  trial.factor = factor;
  trial.verdict = verdict;
  return trial;
}

struct Found {
  FactorBracket bracket;
  std::vector<double> taken;
};

Found search(const CancellableTrial& trial, int at_once,
             const std::optional<FactorRange>& range = std::nullopt) {
  Found found;
  found.bracket = bracket_factor_ahead(trial, at_once, range, tolerance,
                                       [&](const StrengthTrial& t) { found.taken.push_back(t.factor); });
  return found;
}

/// Trials of other length for each factor end in another order than they began.
TEST(TrialsAhead, AreThoseOfOneTrialAfterTheOther) {
  for (const double limit : {0.05, 0.4, 1.07, 1.8, 200.0})
    for (const auto& range : {std::optional<FactorRange>(), std::optional(FactorRange{0.9, 1.6})}) {
      std::vector<double> asked;
      const FactorBracket bracket = bracket_factor(
          [&](double factor) {
            asked.push_back(factor);
            return verdict_at(factor, limit);
          },
          range, tolerance);
      for (const int at_once : {1, 2, 5}) {
        const Found found = search(
            [&](double factor, const std::function<bool()>& given_up) {
              const int steps = static_cast<int>(1e6 * factor) % 7;
              for (int k = 0; k < steps && !given_up(); ++k)
                std::this_thread::sleep_for(std::chrono::microseconds(100));
              return trial_of(factor, given_up() ? Verdict::stopped : verdict_at(factor, limit));
            },
            at_once, range);
        EXPECT_EQ(found.taken, asked) << limit << ' ' << at_once;
        EXPECT_EQ(found.bracket.low, bracket.low);
        EXPECT_EQ(found.bracket.high, bracket.high);
      }
    }
}

/// Counts trials that run; a trial ends when another one has run beside it, so that a search that runs one
/// after the other does not end in time.
TEST(TrialsAhead, RunBesideTheOneThatIsNeeded) {
  std::mutex mutex;
  std::condition_variable changed;
  int n_running = 0, most = 0;
  bool alone = false, needed_runs = false;
  const Found found = search(
      [&](double factor, const std::function<bool()>& given_up) {
        std::unique_lock lock(mutex);
        most = std::max(most, ++n_running);
        needed_runs = needed_runs || factor == 1;
        changed.notify_all();
        const auto both_run = [&] { return factor == 1 ? most >= 2 : needed_runs; };
        if (!changed.wait_for(lock, std::chrono::seconds(30), both_run)) alone = true;
        --n_running;
        return trial_of(factor, given_up() ? Verdict::stopped : verdict_at(factor, 1.2));
      },
      2);
  EXPECT_FALSE(alone);
  EXPECT_TRUE(found.bracket.closed());
}

/// What is not needed never ends by itself here.
TEST(TrialsAhead, AreGivenUpWhenNotNeeded) {
  const Found found = search(
      [&](double factor, const std::function<bool()>& given_up) {
        while (factor > 1 && !given_up()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return trial_of(factor, given_up() ? Verdict::stopped : verdict_at(factor, 0.8));
      },
      2);
  EXPECT_EQ(found.taken.front(), 1);
  EXPECT_LE(found.bracket.low, 0.8);
  EXPECT_GT(found.bracket.high, 0.8);
}

TEST(TrialsAhead, HandOnTheExceptionOfATrialThatIsNeeded) {
  EXPECT_THROW(
      search([](double, const std::function<bool()>&) -> StrengthTrial { throw std::runtime_error("no"); },
             2),
      std::runtime_error);
}

TEST(TrialsAhead, NextFactorsFollowBothVerdicts) {
  EXPECT_EQ(next_factors({}, std::nullopt, tolerance, 3), (std::vector<double>{1, 1.5, 1 / 1.5}));
  EXPECT_EQ(next_factors({{1, Verdict::rests}, {1.5, Verdict::moves}}, std::nullopt, tolerance, 3),
            (std::vector<double>{1.25, 1.375, 1.125}));
  EXPECT_TRUE(
      next_factors({{1, Verdict::rests}, {1.004, Verdict::moves}}, FactorRange{1, 1.004}, tolerance, 3)
          .empty());
}

}  // namespace
