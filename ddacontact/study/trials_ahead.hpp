/// \file A search for the factor of safety with several trials at a time.
///
/// The search needs one trial after the other, and each verdict decides which factor comes next. While a
/// trial runs, those that its two verdicts would lead to run ahead in other threads; what is not needed is
/// given up. Trials that the search needs, and so its answer, are those of one trial after the other.
#pragma once

#include <ddacontact/study/factor_bracket.hpp>
#include <ddacontact/study/strength_trial.hpp>

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace ddacontact {

/// A trial of a factor; ends early, its result of no use, where `given_up` returns true. Called by several
/// threads at a time.
using CancellableTrial = std::function<StrengthTrial(double factor, const std::function<bool()>& given_up)>;

/// As bracket_factor.
/// \param[in] at_once  trials that run at a time, 1 or more
/// \param[in] take     is given each trial that the search needs, in their order, in the calling thread
FactorBracket bracket_factor_ahead(const CancellableTrial& trial, int at_once,
                                   const std::optional<FactorRange>& range, double tolerance,
                                   const std::function<void(const StrengthTrial&)>& take);

/// Factors that bracket_factor tries next: the one that it needs, then those that it needs when unknown
/// trials rest or move, the fewest unknown ones first.
/// \param[in] known  verdicts so far
/// \param[in] n      factors wanted; there are fewer near the end of the search
std::vector<double> next_factors(const std::map<double, Verdict>& known,
                                 const std::optional<FactorRange>& range, double tolerance, std::size_t n);

}  // namespace ddacontact
