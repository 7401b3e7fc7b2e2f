/// \file Runs a scene and takes its invariants.
#pragma once

#include "scene_list.hpp"

#include <map>
#include <string>

namespace regression {

/// The numbers of a scene by their names.
using Measured = std::map<std::string, double>;

/// Runs the scene to its end. Throws Error when it cannot be read or the run stops.
Measured measure(const ListedScene& scene);

}  // namespace regression
