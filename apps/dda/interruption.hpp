/// \file Signals that ask the program to end.
#pragma once

namespace dda {

/// From now on Ctrl-C and SIGTERM are noted, so that what was computed can be kept; a second Ctrl-C ends the
/// program at once. What waits in the kernel returns with EINTR.
void note_interruptions();

/// The signal noted last; 0: none.
int interruption();

}  // namespace dda
