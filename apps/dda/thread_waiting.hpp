/// \file How threads wait for each other.
#pragma once

namespace dda {

/// Starts the program anew with threads that spin for a fraction of a millisecond at most before they sleep:
/// OpenMP's own choice, some milliseconds, makes two threads many times slower than one where other programs
/// use the processors. OpenMP reads it when the program is loaded. Returns where that is chosen already, or
/// where the program cannot be started anew.
void spin_briefly(char** arguments);

}  // namespace dda
