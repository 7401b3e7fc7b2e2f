/// \file The factor at which a scene begins to move, between two others.
#pragma once

#include <functional>
#include <limits>
#include <optional>

namespace ddacontact {

/// What a trial finds.
enum class Verdict { rests, moves, stopped };

/// A range of factors, both > 0.
struct FactorRange {
  double low = 0, high = 0;
};

/// Rests at `low`, moves at `high`.
struct FactorBracket {
  double low = 0;                                         ///< 0: it moves at every factor that was tried
  double high = std::numeric_limits<double>::infinity();  ///< infinite: it rests at every factor
  bool stopped = false;                                   ///< trials without a verdict ended the search

  bool closed() const { return low > 0 && high < std::numeric_limits<double>::infinity(); }
};

/// Without a range the search begins at 1 and goes by factors of 1.5, between these two.
inline constexpr FactorRange widest_range{0.1, 100};

/// Brackets the factor, then halves the bracket until it is narrower than `tolerance` times its low end.
/// A trial without a verdict is passed: the next factor is tried, or those at a third and at two thirds of
/// the bracket instead of the one in its middle. Where these have none either, the search ends.
///
/// \param[in] range  its ends are tried first; where one of them has the other's verdict the search ends
FactorBracket bracket_factor(const std::function<Verdict(double)>& try_factor,
                             const std::optional<FactorRange>& range, double tolerance);

}  // namespace ddacontact
