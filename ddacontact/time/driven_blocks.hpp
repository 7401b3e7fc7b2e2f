/// \file Blocks that overlap where no force can part them: driven by supports, or brought by a stage.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <functional>
#include <optional>

namespace ddacontact {

/// The first two blocks without free unknowns of which the supports of one or both have driven one deeper
/// into the other than they were drawn, by a millionth of the smaller one's size; nothing where there are
/// none.
/// \param[in] gives_way  whether a joint with a stiffness lets two blocks overlap
std::optional<Pair> find_driven_overlap(const BlockSystem& blocks, const BlockState& end,
                                        const std::function<bool(const Pair&)>& gives_way);

/// The first of these blocks, which come in, with one that is there and not among `leaving` that it overlaps
/// by more than `deepest_overlap`; nothing where there is none.
std::optional<Pair> find_overlap(const BlockSystem& blocks, const BlockState& state,
                                 const std::vector<int>& coming, const std::vector<int>& leaving);

}  // namespace ddacontact
