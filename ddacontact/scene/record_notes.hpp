/// \file What is to be known of the ground motions that a scene names.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// A line for each acceleration record, once where several supports follow it: how many entries, its largest
/// value in SI units, and where its integrals end, for no baseline is corrected. Pulses of fewer than five
/// entries are left out.
std::vector<std::string> notes_on_records(const Scene& scene);

}  // namespace ddacontact::scene_format
