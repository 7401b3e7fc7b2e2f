#include <ddacontact/study/trials_ahead.hpp>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

namespace ddacontact {

namespace {

/// One trial in a thread of its own.
struct Attempt {
  std::atomic<bool> given_up = false;
  bool finished = false;  ///< guarded by TrialsAhead::mutex_, as the result is
  StrengthTrial trial;
  std::exception_ptr failure;
  std::jthread thread;  ///< the last member: joined before the others go
};

class TrialsAhead {
 public:
  TrialsAhead(const CancellableTrial& trial, int at_once, const std::optional<FactorRange>& range,
              double tolerance)
      : trial_(trial),
        at_once_(static_cast<std::size_t>(std::max(at_once, 1))),
        range_(range),
        tolerance_(tolerance) {}
  ~TrialsAhead() {
    for (auto& [factor, attempt] : attempts_) attempt->given_up = true;
  }
  TrialsAhead(const TrialsAhead&) = delete;
  TrialsAhead& operator=(const TrialsAhead&) = delete;

  /// The factor that the search needs, which is next_factors().front().
  const StrengthTrial& result(double factor) {
    std::unique_lock lock(mutex_);
    for (;;) {
      run_next();
      const Attempt& needed = *attempts_.at(factor);
      if (needed.failure) std::rethrow_exception(needed.failure);
      if (needed.finished) return needed.trial;
      const long seen = n_finished_;
      changed_.wait(lock, [&] { return n_finished_ > seen; });
    }
  }

 private:
  /// Gives up what is not among the next factors, begins what is not under way.
  void run_next() {
    std::map<double, Verdict> known;
    for (const auto& [factor, attempt] : attempts_)
      if (attempt->finished) known[factor] = attempt->trial.verdict;
    const std::vector<double> next = next_factors(known, range_, tolerance_, at_once_);
    for (auto at = attempts_.begin(); at != attempts_.end();) {
      if (at->second->finished || std::ranges::count(next, at->first) > 0) {
        ++at;
        continue;
      }
      at->second->given_up = true;
      given_up_.push_back(std::move(at->second));
      at = attempts_.erase(at);
    }
    for (const double factor : next)
      if (!attempts_.contains(factor)) begin(factor);
  }

  void begin(double factor) {
    Attempt& attempt = *(attempts_[factor] = std::make_unique<Attempt>());
    attempt.thread = std::jthread([this, factor, &attempt] {
      StrengthTrial trial;
      std::exception_ptr failure;
      try {
        trial = trial_(factor, [&attempt] { return attempt.given_up.load(); });
      } catch (...) {
        failure = std::current_exception();
      }
      const std::lock_guard lock(mutex_);
      attempt.trial = std::move(trial);
      attempt.failure = failure;
      attempt.finished = true;
      ++n_finished_;
      changed_.notify_all();
    });
  }

  const CancellableTrial& trial_;
  std::size_t at_once_;
  std::optional<FactorRange> range_;
  double tolerance_;
  std::mutex mutex_;
  std::condition_variable changed_;
  long n_finished_ = 0;
  std::map<double, std::unique_ptr<Attempt>> attempts_;  ///< by factor
  std::vector<std::unique_ptr<Attempt>> given_up_;
};

}  // namespace

std::vector<double> next_factors(const std::map<double, Verdict>& known,
                                 const std::optional<FactorRange>& range, double tolerance, std::size_t n) {
  std::vector<double> next;
  std::deque<std::map<double, Verdict>> assumed{known};
  for (; !assumed.empty() && next.size() < n; assumed.pop_front()) {
    std::map<double, Verdict>& verdicts = assumed.front();
    std::optional<double> unknown;
    const auto look_up = [&](double factor) {
      const auto found = verdicts.find(factor);
      if (found != verdicts.end()) return found->second;
      if (!unknown) unknown = factor;
      return Verdict::stopped;
    };
    bracket_factor(look_up, range, tolerance);
    if (!unknown) continue;
    if (std::ranges::count(next, *unknown) == 0) next.push_back(*unknown);
    // A trial that rests takes longest: what follows it has the most time to run ahead.
    for (const Verdict verdict : {Verdict::rests, Verdict::moves}) {
      verdicts[*unknown] = verdict;
      assumed.push_back(verdicts);
    }
  }
  return next;
}

FactorBracket bracket_factor_ahead(const CancellableTrial& trial, int at_once,
                                   const std::optional<FactorRange>& range, double tolerance,
                                   const std::function<void(const StrengthTrial&)>& take) {
  TrialsAhead trials(trial, at_once, range, tolerance);
  const auto try_factor = [&](double factor) {
    const StrengthTrial& result = trials.result(factor);
    take(result);
    return result.verdict;
  };
  return bracket_factor(try_factor, range, tolerance);
}

}  // namespace ddacontact
