/// \file Supports, loads, shaking and monitors of a scene file: what acts on blocks and what watches them.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

#include <vector>

namespace ddacontact::scene_format {

/// Notes in `blocks.holds` which vertices are held.
std::vector<Support> resolve_supports(const Document& document, BlockTable& blocks, ProblemList& problems);
std::vector<Load> resolve_loads(const Document& document, const BlockTable& blocks, ProblemList& problems);
/// Those that hold their faces are a problem.
std::vector<QuietBoundary> resolve_quiet_boundaries(const Document& document, BlockTable& blocks,
                                                    ProblemList& problems);
std::vector<Quake> resolve_quakes(const Document& document, ProblemList& problems);
std::vector<Monitor> resolve_monitors(const Document& document, const BlockTable& blocks,
                                      ProblemList& problems);

}  // namespace ddacontact::scene_format
