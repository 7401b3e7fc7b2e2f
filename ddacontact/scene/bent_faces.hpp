/// \file Blocks that end where the face below them bends.
#pragma once

#include <ddacontact/scene/held_corners.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// A corner cannot slide round a bend inwards of the face below it: it meets the lower part of the face.
/// Found are the upper of two free blocks with a corner each at a bend, and a single one on one part of a
/// face that bends by less than a right angle, as the foot of a sliding body at the level ground below it;
/// this one also a little before the bend, and where it is one between the faces of two blocks that stay held.
/// The first such bend in words; nothing where there is none.
std::optional<std::string> note_on_bent_face(const BlockSystem& blocks, const BlockState& initial,
                                             const std::vector<HeldCorner>& held);

}  // namespace ddacontact
