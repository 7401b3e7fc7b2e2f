#include "interruption.hpp"

#include <atomic>

namespace dda {

namespace {

std::atomic<int> signal_noted = 0;
static_assert(std::atomic<int>::is_always_lock_free);

extern "C" void note_signal(int number) {
  signal_noted = number;
  if (number == SIGINT) std::signal(number, SIG_DFL);
}

}  // namespace

void note_interruptions(int flags) {
  struct sigaction action {};
  action.sa_handler = note_signal;
  action.sa_flags = flags;
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

void end_at_interruptions() {
  for (const int number : {SIGINT, SIGTERM}) std::signal(number, SIG_DFL);
}

int interruption() {
  return signal_noted;
}

}  // namespace dda
