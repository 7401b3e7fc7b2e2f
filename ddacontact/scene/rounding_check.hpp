/// \file Whether the blocks of a scene are large enough for their rounded corners.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

namespace ddacontact::scene_format {

/// A problem where the circles at the two ends of an edge would use it up: a warning, where there are blocks
/// for which they do not. All outlines must be valid.
void check_corner_rounding(const Document& document, const Scene& scene, const BlockTable& blocks,
                           ProblemList& problems);

}  // namespace ddacontact::scene_format
