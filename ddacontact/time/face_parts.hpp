/// \file Which parts of the blocks' faces touch others.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <vector>

namespace ddacontact {

/// A part of an edge and the block that touches it at the start.
struct FacePart {
  WetFace face;
  int neighbour = -1;  ///< < 0: none
};

/// All edges, divided where blocks that touch them begin and end, at their reference positions.
std::vector<FacePart> divide_faces(const BlockSystem& blocks);

/// Faces of the blocks that are present; they are in a joint where the neighbour is present too.
std::vector<WetFace> present_faces(const BlockSystem& blocks, const std::vector<FacePart>& parts);

}  // namespace ddacontact
