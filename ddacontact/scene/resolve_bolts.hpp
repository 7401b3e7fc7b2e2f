/// \file Bolts of a scene file.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

#include <vector>

namespace ddacontact::scene_format {

struct ResolvedBolts {
  NameTable names{"bolt"};
  std::vector<RockBolt> bolts;
  std::vector<std::vector<int>> blocks;  ///< that each of them holds together
};

/// \param[in] descriptions  of the blocks
ResolvedBolts resolve_bolts(const Document& document, const BlockTable& blocks,
                            const std::vector<BlockDescription>& descriptions, ContactMethod method,
                            ProblemList& problems);

/// A bolt that no stage names in `add` comes in with the last of its blocks; none may be there before them.
/// \param[in] blocks  with the stages that they come in with
void bring_bolts(const Document& document, const ResolvedBolts& bolts, const BlockTable& blocks,
                 std::vector<StageDescription>& stages, ProblemList& problems);

}  // namespace ddacontact::scene_format
