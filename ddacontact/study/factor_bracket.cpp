#include <ddacontact/study/factor_bracket.hpp>

namespace ddacontact {

namespace {

constexpr double growth = 1.5;

class Search {
 public:
  explicit Search(const std::function<Verdict(double)>& try_factor) : try_factor_(try_factor) {}

  /// Puts the factor into the bracket; false when the trial gave no verdict.
  bool take(double factor) {
    const Verdict verdict = try_factor_(factor);
    if (verdict == Verdict::rests) bracket.low = factor;
    if (verdict == Verdict::moves) bracket.high = factor;
    bracket.stopped = verdict == Verdict::stopped;
    return !bracket.stopped;
  }

  /// Where a trial gives no verdict, the next factor is tried.
  void widen() {
    double factor = 1;
    if (!take(factor) && !take(factor * growth)) return;
    while (bracket.low == 0 && factor > widest_range.low)
      if (!take(factor /= growth) && !take(factor /= growth)) return;
    factor = bracket.low;
    while (!bracket.closed() && bracket.low > 0 && factor < widest_range.high)
      if (!take(factor *= growth) && !take(factor *= growth)) return;
  }

  void halve(double tolerance) {
    while (bracket.closed() && bracket.high - bracket.low > tolerance * bracket.low)
      if (!divide()) return;
  }

  FactorBracket bracket;

 private:
  /// False when no trial within the bracket gave a verdict.
  bool divide() {
    const double low = bracket.low, high = bracket.high;
    return take((low + high) / 2) || take((2 * low + high) / 3) || take((low + 2 * high) / 3);
  }

  const std::function<Verdict(double)>& try_factor_;
};

}  // namespace

FactorBracket bracket_factor(const std::function<Verdict(double)>& try_factor,
                             const std::optional<FactorRange>& range, double tolerance) {
  Search search(try_factor);
  if (!range)
    search.widen();
  else if (search.take(range->low) && search.bracket.low > 0)
    search.take(range->high);
  if (!search.bracket.stopped) search.halve(tolerance);
  return search.bracket;
}

}  // namespace ddacontact
