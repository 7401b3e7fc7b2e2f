/// \file What the program's exit status says.
#pragma once

namespace dda {

enum ExitStatus {
  done = 0,
  wrong_input = 2,       ///< the input or the call is wrong; nothing was written
  analysis_stopped = 3,  ///< what was computed is kept
  file_error = 4,        ///< a file could not be read or written
  interrupted = 128      ///< plus the signal's number
};

}  // namespace dda
