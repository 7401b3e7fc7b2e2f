#include "thread_waiting.hpp"

#include <unistd.h>

#include <cstdlib>

namespace dda {

void spin_briefly(char** arguments) {
  if (std::getenv("OMP_WAIT_POLICY") || std::getenv("GOMP_SPINCOUNT")) return;
  ::setenv("GOMP_SPINCOUNT", "10000", 0);
  ::execv("/proc/self/exe", arguments);
}

}  // namespace dda
