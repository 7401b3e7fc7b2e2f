/// \file Signals that ask the program to end.
#pragma once

#include <csignal>

namespace dda {

/// From now on Ctrl-C and SIGTERM are noted, so that what was computed can be kept; a second Ctrl-C ends the
/// program at once.
/// \param[in] flags  of sigaction; 0: what waits in the kernel returns with EINTR
void note_interruptions(int flags = SA_RESTART);
/// From now on both end the program at once.
void end_at_interruptions();

/// The signal noted last; 0: none.
int interruption();

}  // namespace dda
