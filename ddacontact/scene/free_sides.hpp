/// \file Warns of sides of a domain that nothing holds.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

namespace ddacontact::scene_format {

/// A domain is a part of the rock, cut out on the left, on the right and below. Where its outline lies on one
/// of these sides of its box, warns of edges that are not held, although other blocks of the domain are:
/// slivers slide out there, and a factor of safety is theirs. An edge is held by a vertex of it that is held,
/// by a pressure, by a quiet boundary or by a block that does not belong to the domain. A rectangle without
/// openings is a specimen with free faces: it is left alone.
void warn_of_free_sides(const Document& document, const Scene& scene, const BlockTable& blocks,
                        ProblemList& problems);

}  // namespace ddacontact::scene_format
