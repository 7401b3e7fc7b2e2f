#include "interruption.hpp"

#include <csignal>

namespace dda {

namespace {

volatile std::sig_atomic_t signal_noted = 0;

extern "C" void note_signal(int number) {
  signal_noted = number;
  if (number == SIGINT) std::signal(number, SIG_DFL);
}

}  // namespace

void note_interruptions() {
  struct sigaction action {};
  action.sa_handler = note_signal;
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

int interruption() {
  return signal_noted;
}

}  // namespace dda
