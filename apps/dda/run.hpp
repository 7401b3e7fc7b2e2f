/// \file `dda run`: runs a scene and writes its results.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace dda {

struct RunArguments {
  std::string scene;
  std::string directory;              ///< empty: the scene's name without its ending, plus "-out"
  std::optional<int> steps;           ///< where to stop, in steps from the start
  std::vector<std::string> settings;  ///< PATH=VALUE
  std::string checkpoint;             ///< to go on from; empty: from the start
  bool as_stage = false;              ///< the scene is the next stage of the checkpoint's run
  int threads = 1;                    ///< results are the same for any number
  bool force = false;                 ///< older results are overwritten, not renamed
  bool quiet = false;
};

/// Returns the exit status.
int run(const RunArguments& arguments);

}  // namespace dda
