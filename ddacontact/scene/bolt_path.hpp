/// \file Which blocks a bolt passes, the nodes that it is divided at, and how it buckles.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <vector>

namespace ddacontact {

/// A point belongs to a block up to this times the block's size outside of it.
inline constexpr double bolt_tolerance = 1e-9;

/// A part of a bolt in one block: distances from its first point, m.
struct BoltPiece {
  int block = 0;
  double from = 0, to = 0;
};

/// A point of a block that a bolt is fixed or bonded to.
struct BoltNode {
  int block = 0;
  Vec2 at{0, 0};      ///< at the start of the run
  double length = 0;  ///< of the bar that it is bonded to, m; 0: anchored
};

/// The blocks that hold a point, in their order; several where it lies on a common face.
std::vector<int> blocks_at(const Vec2& point, const std::vector<BlockDescription>& blocks);
/// From the first point to the last one. Where a bolt runs along a face both its blocks may have it, or none.
std::vector<BoltPiece> bolt_pieces(const RockBolt& bolt, const std::vector<BlockDescription>& blocks);
/// Of an anchored bolt its ends; of a grouted one the middles of lengths, equal within each block, of at most
/// a sixth of the length sqrt(E A / bond stiffness) over which its force fades: what is left of the error is
/// (1/6)^2 / 8 of a force across a joint.
std::vector<BoltNode> bolt_nodes(const RockBolt& bolt, const std::vector<BlockDescription>& blocks);

/// The compression at which a round bar of the bolt's section, free and pinned at its ends, buckles, N.
double euler_load(const RockBolt& bolt);

}  // namespace ddacontact
