/// \file Whether the blocks of a run come to rest or move away, from where they stand now.
#pragma once

#include <ddacontact/study/factor_bracket.hpp>
#include <ddacontact/time/stepper.hpp>

#include <functional>
#include <string>
#include <vector>

namespace ddacontact {

/// When a trial ends, and how.
///
/// It rests after `steps_at_rest` steps in a row, all of them after the last change of a load, a support or
/// the ground, at whose end all forces are in balance and no vertex moves
/// faster than `rest_speed`, unless a vertex is then further than `slip` from where it was at the start: it
/// has failed and found another place, where water, loads or joints may bear less on it. It moves when a
/// vertex is further than `displacement` and forces are not in balance, or when some vertex has been further
/// than `slip` for half of the steps of the stage in a row: what creeps or rocks there has failed as well.
/// Where none of these comes true in `time_factor` times the steps of the stage (of `fewest_steps` at least)
/// since the last change, it rests if no vertex went further in the second half of these steps than before,
/// else it moves.
struct TrialLimits {
  double displacement = 0.05;  ///< sizes of its block
  double slip = 0.02;  ///< sizes of its block: soft blocks slide by a hundredth as they settle near the limit
  double rest_speed = 1e-5;  ///< sizes of its block a second
  int steps_at_rest = 10;
  int time_factor = 5, fewest_steps = 200;
};

/// How a trial ended.
struct StrengthTrial {
  double factor = 0;
  Verdict verdict = Verdict::stopped;
  std::string reason;           ///< what decided
  double max_displacement = 0;  ///< of any vertex at the end, m
  double kinetic = 0;           ///< at the end, J per m
  double unbalanced = 0;        ///< at the end, see Equilibrium
  double time = 0;              ///< that it took, s
  long steps = 0;
  int first_block = -1;           ///< whose vertex went furthest, in sizes of the block
  std::vector<int> moved_blocks;  ///< that went a tenth as far at least, ascending
  std::string pulled_bonds;       ///< see `describe_pulled_bonds`
  long broken_bonds = 0;          ///< since the run began
  Points displacements;           ///< of all vertices since the start of the trial, m
};

/// Steps until one of the limits decides. `stopped` when the stepper stops before, or where `given_up`, called
/// before every step and after every trial step, returns true.
StrengthTrial run_trial(Stepper& stepper, const TrialLimits& limits, const std::function<bool()>& given_up);

}  // namespace ddacontact
