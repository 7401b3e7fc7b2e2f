/// \file Blocks that supports move wholly: what they do to each other no force can change.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <optional>

namespace ddacontact {

/// The first two blocks without free unknowns of which the supports of one or both have driven one deeper
/// into the other than a millionth of the smaller one's size; nothing where there are none.
std::optional<Pair> find_driven_overlap(const BlockSystem& blocks, const BlockState& start,
                                        const BlockState& end);

}  // namespace ddacontact
