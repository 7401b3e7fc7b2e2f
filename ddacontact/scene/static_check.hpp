/// \file Free blocks that nothing would hold in a static analysis.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

namespace ddacontact::scene_format {

/// Blocks no further apart than this times the size of the pair hold each other.
inline constexpr double nearly_touching = 1e-2;

/// A problem for each block that nothing can hold, the first 1000 of them. A block is held when a vertex of
/// it is, in any direction; when it nearly touches a block that is held; and when it lies above one, so that
/// it would fall onto it: their boxes along gravity overlap across it, and the other one reaches lower.
/// All outlines must be sound.
void check_statics(const BlockTable& blocks, const Vec2& gravity, ProblemList& problems);

}  // namespace ddacontact::scene_format
