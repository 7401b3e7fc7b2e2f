/// \file Corners at which blocks that stay held lie against each other.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/time/stage.hpp>

#include <vector>

namespace ddacontact {

/// A corner of a held block with others around it. What is free there is the outside of all of them together.
struct HeldCorner {
  int block, vertex;  ///< of the block, 0 .. n_vertices - 1
  Vec2 at;
  bool is_first;  ///< no block before this one has a vertex there
  double free;    ///< the largest angle that is free there, radians; 0: none
  /// Unit vectors along the surface to the corner and from it, counter-clockwise as an outline, and the blocks
  /// whose faces these are.
  Vec2 in, out;
  int in_block, out_block;
};

/// Those at which two blocks or more meet that are wholly held where they are, and there, in all stages; by
/// block and vertex.
std::vector<HeldCorner> held_corners(const BlockSystem& blocks, const BlockState& initial,
                                     const std::vector<Stage>& stages);

}  // namespace ddacontact
