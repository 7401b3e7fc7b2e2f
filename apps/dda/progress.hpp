/// \file How far a run is, on stderr.
#pragma once

#include <ddacontact/time/stepper.hpp>

#include <chrono>

namespace dda {

/// On a terminal one line that is written over, otherwise a plain line every tenth of the run.
class Progress {
 public:
  /// \param[in] steps  how many the run is to take
  Progress(int steps, bool quiet);
  void show(const ddacontact::Stepper& stepper);
  /// Ends the terminal's line.
  void finish() const;

 private:
  int steps_;
  bool quiet_, terminal_;
  long iterations_before_ = 0;
  std::chrono::steady_clock::time_point start_, last_shown_;
};

}  // namespace dda
