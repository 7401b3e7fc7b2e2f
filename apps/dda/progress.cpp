#include "progress.hpp"

#include "messages.hpp"

#include <unistd.h>

#include <algorithm>

namespace dda {

using Clock = std::chrono::steady_clock;

Progress::Progress(int steps, bool quiet)
    : steps_(steps), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()) {}

void Progress::show(const ddacontact::Stepper& stepper) {
  const ddacontact::StepCounts& counts = stepper.counts();
  const long iterations = counts.contact_iterations - iterations_before_;
  iterations_before_ = counts.contact_iterations;
  if (quiet_) return;
  const auto now = Clock::now();
  const bool last = counts.steps == steps_;
  if (terminal_) {
    if (!last && now - last_shown_ < std::chrono::milliseconds(100)) return;
  } else if (!last && counts.steps % std::max(1, steps_ / 10) != 0) {
    return;
  }
  last_shown_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const double left =
      elapsed / static_cast<double>(counts.steps) * static_cast<double>(steps_ - counts.steps);
  say("{}step {}/{}  time {:.6g} s  dt {:.3g} s  iterations {}  contacts {}  left {:.0f} s{}",
      terminal_ ? "\r" : "", counts.steps, steps_, stepper.state().time, stepper.last_dt(), iterations,
      counts.contacts, left, terminal_ ? "\033[K" : "\n");
}

void Progress::finish() const {
  if (!quiet_ && terminal_) say("\n");
}

}  // namespace dda
