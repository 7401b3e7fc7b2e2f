/// \file Values that a scene may have, and that are rarely meant.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// A line for each: friction angles that look like coefficients of friction or radians, and sections of bolts
/// that look like another unit.
std::vector<std::string> notes_on_unlikely_values(const Scene& scene);

}  // namespace ddacontact::scene_format
