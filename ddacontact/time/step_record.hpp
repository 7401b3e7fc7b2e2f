/// \file Everything that the next step depends on beside the scene, so that it can be made again alone.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/time/sleeping.hpp>

#include <vector>

namespace ddacontact {

/// Position of a run in its stages.
struct StageProgress {
  int stage = 0;
  long steps = 0;                      ///< made in this stage
  bool came_to_rest = false;           ///< its `until` came true: it is over
  std::vector<double> start_times{0};  ///< of all stages up to this one, s

  double start_time() const { return start_times.back(); }
};

/// State of a run. Of the contacts it keeps the data that one step hands to the next: which they are, their
/// history and their slip at the end.
struct StepRecord {
  long steps = 0;      ///< whole steps made
  bool begun = false;  ///< a substep has been made: contacts carry on those of the record
  double substep = 0;  ///< the length to try next, s
  StageProgress progress;
  BlockState state;
  FadingForces fading;
  std::vector<ContactRecord> contacts;  ///< of the last substep
  SleepRecord sleeping;                 ///< without entries: all are awake
};

}  // namespace ddacontact
