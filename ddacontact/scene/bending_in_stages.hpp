/// \file What bends the blocks of a scene in any of its stages.
#pragma once

#include <ddacontact/time/stage.hpp>

#include <vector>

namespace ddacontact {

/// The largest of `missing_bending` over the stages, each at rest under its loads, where the scene is drawn.
/// All are < 0, not known, where some stage finds no rest. Infinity: supports deform the block.
/// \param[in,out] blocks  as the scene has them; as in the last stage then
std::vector<double> missing_in_stages(BlockSystem& blocks, BlockState initial,
                                      const ContactProperties& contacts, const std::vector<Stage>& stages);

}  // namespace ddacontact
