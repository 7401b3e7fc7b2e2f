/// \file What models of blocks leave out of buckling.
#pragma once

#include <ddacontact/block/block_system.hpp>

namespace ddacontact {

/// A strut of the length of a block, of a section with its second moment, pinned at both ends.
struct Buckling {
  int block = -1;          ///< -1: no block that the model keeps from it is pressed along its length
  double of_critical = 0;  ///< its thrust over Euler's critical load
};

/// Of the blocks within which bending does not grow by thrust the one that is nearest to buckling: those
/// without cells and, unless cells turn on their own (`follows_cells`), all.
Buckling nearest_to_buckling(const BlockSystem& blocks, const BlockState& state, bool follows_cells);

}  // namespace ddacontact
