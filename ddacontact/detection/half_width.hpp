/// \file How deep a vertex may lie inside a polygon and still be taken for one that came through the near
/// side.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Half the width of a polygon, m: area over perimeter, as of a slab. Of a concave polygon no more than half
/// the thickness of its thinnest part: the least distance of a vertex behind an edge, the two facing away
/// from each other.
double half_width(const polyfem::PointsRef& polygon);

}  // namespace ddacontact
