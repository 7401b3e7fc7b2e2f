/// \file Blocks that overlap where no force can part them: driven by supports, or brought by a stage.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace ddacontact {

/// The first two blocks with supports that overlap since these move one or both: by more than a millionth of
/// the smaller one's size, by more than `deepest_overlap` of it where one of them has free unknowns, and by as
/// much more than they were drawn. Nothing where there are none.
/// \param[in] gives_way  whether a joint with a stiffness, a penalty or rounded corners in contact let two blocks
///   overlap
std::optional<Pair> find_driven_overlap(const BlockSystem& blocks, const BlockState& end,
                                        const std::function<bool(const Pair&)>& gives_way);

/// The first of the blocks `coming` that overlaps a present one which is not among `leaving`, by more than
/// `deepest_overlap` of the smaller one's size, with that one; nothing where there is none.
std::optional<Pair> find_overlap(const BlockSystem& blocks, const BlockState& state,
                                 const std::vector<int>& coming, const std::vector<int>& leaving);

}  // namespace ddacontact
