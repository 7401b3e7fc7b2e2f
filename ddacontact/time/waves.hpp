/// \file Whether blocks are rigid within a step, or carry waves from one step to the next.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>

namespace ddacontact {

/// Travel time of a pressure wave through a block: its size over the square root of (lambda + 2 mu) /
/// density, s.
double transit_time(const Block& block);

/// Duration of an impact at a contact, s: the shorter time in which a pressure wave crosses one of its
/// movable blocks, which then passes on the impulse.
double impact_duration(const BlockSystem& blocks, const Contact& contact);
/// Whether the step is shorter than a pressure wave takes across either block of a contact: velocities of the
/// two then change by the wave that comes through, step by step, and not at once by rigid motions.
inline bool carries_waves(const BlockSystem& blocks, const Contact& contact, double dt) {
  return dt < impact_duration(blocks, contact);
}

}  // namespace ddacontact
