/// \file Records of earthquakes whose time runs while blocks are brought to rest.
#pragma once

#include <ddacontact/scene/problem_list.hpp>
#include <ddacontact/scene/records.hpp>
#include <ddacontact/scene/scene.hpp>

namespace ddacontact::scene_format {

/// Warns of records that shake the ground in static stages before dynamic ones: it is a load without inertia
/// there, and what has passed shakes no more when blocks can move.
void warn_of_early_quakes(const Document& document, const Scene& scene, ProblemList& problems);

}  // namespace ddacontact::scene_format
