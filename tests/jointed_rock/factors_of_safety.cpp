/// \file Factors of safety of random slopes by strength reduction, against limit analysis.
#include "chapters.hpp"
#include "slope_factors.hpp"

#include <fmt/format.h>
#include <ddacontact/study/safety_files.hpp>

#include <algorithm>

namespace jointed_rock {

void factors_of_safety(Report& report) {
  constexpr int n_slopes = 50;
  constexpr double tolerance = 0.01;
  constexpr support::SlopeSize size{20, 40};
  report.heading("Factors of safety");
  report.paragraph(fmt::format(
      "{} random slopes of {} to {} free blocks, friction {:g} times the limiting tan φ, by strength "
      "reduction as `dda safety` does it (`ddacontact/study`), to {:g} %. All factors are over that of the "
      "linear program. *interlocked* is the factor of the same program where corners that meet at crossings "
      "of joints press on each other in every direction between them. Beyond it no admissible forces exist "
      "at all, below it some exist once joints have slipped by a hair; strength reduction relies on none. A "
      "*plane* is the mechanism where what moves first slides along one plane of the limiting dip. Elsewhere "
      "strength reduction is below the program where blocks slide on several planes, because the program "
      "lets "
      "them dilate by φ. *rounded* is what the trial with rounded corners does with which `dda safety` ends, "
      "at 95 % of the factor: it warns where that moves.",
      n_slopes, size.least, size.most, known_factor, 100 * tolerance));
  std::vector<std::vector<std::string>> rows{
      {"seed", "free blocks", "limiting φ", "strength reduction", "interlocked", "mechanism", "rounded"}};
  Slopes slopes(size);
  int n_stopped_planes = 0, n_never_above = 0, n_planes = 0, n_close = 0, n_above_passing = 0, n_decided = 0;
  int n_rounded_move = 0;
  double lowest = 1, highest = 1;
  for (int k = 0; k < n_slopes; ++k) {
    const Slope slope = slopes.next();
    const SlopeFactor factor = factor_of(slope, tolerance);
    n_never_above += factor.never_above();
    n_above_passing += factor.found.low > most_above;
    n_planes += factor.on_a_plane;
    n_close += factor.on_a_plane && factor.close_on_a_plane();
    n_stopped_planes += factor.on_a_plane && factor.found.stopped;
    n_decided += !factor.found.stopped;
    const StrengthTrial rounded = rounded_trial(slope, factor);
    n_rounded_move += rounded.verdict == ddacontact::Verdict::moves;
    lowest = std::min(lowest, factor.found.low);
    highest = std::max(highest, factor.found.low);
    rows.push_back({std::to_string(slope.seed), std::to_string(slope.n_free),
                    fmt::format("{:.2f}°", degrees(slope.limit)),
                    fmt::format("{:.3f} .. {:.3f}{}", factor.found.low, factor.found.high,
                                factor.found.stopped ? ", stopped" : ""),
                    fmt::format("{:.3f}", factor.interlocked), factor.on_a_plane ? "plane" : "several blocks",
                    word_of(rounded.verdict)});
  }
  report.table(rows);
  report.claims(
      {{"Strength reduction is never more than 1 % above the factor at which no admissible forces exist.",
        n_never_above == n_slopes, fmt::format("{} of {}", n_never_above, n_slopes)},
       {"Strength reduction is never more than 1 % above the factor at which corners pass each other.",
        n_above_passing == 0,
        fmt::format("{} of {} above, by {:.0f} % at most", n_above_passing, n_slopes, 100 * (highest - 1))},
       {"With rounded corners nothing moves at 95 % of the factor.", n_rounded_move == 0,
        fmt::format("{} of {} move", n_rounded_move, n_slopes)},
       {"It is within 3 % of limit analysis where a single plane is the mechanism.", n_close == n_planes,
        fmt::format("{} of {}, searches that stopped early: {}; elsewhere down to {:.2f}", n_close, n_planes,
                    n_stopped_planes, lowest)},
       {"Every search ends with a bracket of 1 %.", n_decided == n_slopes,
        fmt::format("{} of {}", n_decided, n_slopes)}});
}

}  // namespace jointed_rock
