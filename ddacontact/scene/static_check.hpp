/// \file Free blocks that nothing would hold in a static analysis.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

#include <string>
#include <vector>

namespace ddacontact::scene_format {

/// Blocks no further apart than this times the size of the pair hold each other.
inline constexpr double nearly_touching = 1e-2;

/// A static part of a run.
struct StaticPart {
  std::string title;            ///< in messages: "a static analysis"
  std::vector<bool> has;        ///< of each block: whether it is there
  std::vector<Vec2> gravities;  ///< of the static parts up to this one, none of them 0
  bool after_motion = false;    ///< a dynamic part goes before: where blocks are is not known
};

/// The static ones of the stages, or of the whole run when there are none.
std::vector<StaticPart> static_parts(const Scene& scene);

/// A problem for each block that nothing can hold in some part, the first 1000 of them; after motion a
/// warning. A block is held when a vertex of it is, in any direction; when it nearly touches a block that is
/// held, or hangs from it by a bolt; and when it lies above one, so that it would fall onto it: their boxes
/// along gravity overlap across it, and the other one reaches lower. All outlines must be valid.
/// \param[in] tied  blocks that hold each other by a bolt, of each of these
void check_statics(const BlockTable& blocks, const std::vector<StaticPart>& parts,
                   const std::vector<std::vector<int>>& tied, ProblemList& problems);

}  // namespace ddacontact::scene_format
