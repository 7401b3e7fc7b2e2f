/// \file What tolerances of a contact are relative to.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/detection/narrow_phase.hpp>

#include <algorithm>
#include <limits>

namespace support {

/// The size of the smaller of two blocks in contact, those that cannot move not counted, m.
inline double pair_size(const ddacontact::BlockSystem& blocks, const ddacontact::VertexEdge& pair) {
  double size = std::numeric_limits<double>::infinity();
  for (const int b : {pair.vertex_block, pair.edge_block})
    if (blocks.is_movable(b)) size = std::min(size, blocks.block(b).size());
  return size;
}

}  // namespace support
