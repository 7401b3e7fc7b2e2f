/// \file `dda check`: reads and checks scenes, computes nothing.
#pragma once

#include <string>
#include <vector>

namespace dda {

/// Looks at every file and returns the worst exit status.
int check(const std::vector<std::string>& scenes, const std::vector<std::string>& settings);

}  // namespace dda
