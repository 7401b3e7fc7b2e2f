/// \file Blocks with rounded coordinates made to touch.
#pragma once

#include <ddacontact/scene/records.hpp>

namespace ddacontact::scene_format {

/// Snaps the outlines of all blocks within the document's `snap`, where it has one.
void snap_blocks(Document& document, ProblemList& problems);

}  // namespace ddacontact::scene_format
