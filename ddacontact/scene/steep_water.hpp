/// \file Water that leaves a face as soon as its block moves.
#pragma once

#include <ddacontact/time/stage.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// Water stands where its table is: where that falls steeply beside a face, the block moves out of the water
/// before it has failed. The first free block that what a factor of safety counts as its failure, a fiftieth
/// of its size to either side, changes the water on by more than a hundredth of its weight, in words; nothing
/// where there is none.
std::optional<std::string> note_on_steep_water(const BlockSystem& blocks, const BlockState& initial,
                                               const std::vector<Stage>& stages);

}  // namespace ddacontact
