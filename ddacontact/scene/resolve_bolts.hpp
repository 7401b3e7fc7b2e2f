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

}  // namespace ddacontact::scene_format
