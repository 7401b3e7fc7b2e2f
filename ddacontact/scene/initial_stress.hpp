/// \file [initial_stress]: what blocks that state no stress of their own begin with.
#pragma once

#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

/// Gives each of them the stress at its centroid, which is the mean over the block, and its gradient.
void put_initial_stress(Document& document);

}  // namespace ddacontact::scene_format
