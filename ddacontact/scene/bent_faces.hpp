/// \file Joints that end where the face below them bends.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <optional>
#include <string>

namespace ddacontact {

/// Where a face bends inwards and two free blocks have a corner each at the bend, the upper one cannot slide
/// round it: its corner meets the lower part of the face. The first such bend in words; nothing where
/// there is none.
std::optional<std::string> note_on_bent_face(const BlockSystem& blocks, const BlockState& initial);

}  // namespace ddacontact
