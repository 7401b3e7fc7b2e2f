/// \file Warns of a time scheme that is not stable for the blocks of a scene, or does not suit its joints.
#pragma once

#include <ddacontact/scene/names.hpp>
#include <ddacontact/scene/records.hpp>

#include <vector>

namespace ddacontact::scene_format {

/// Newmark's scheme with gamma < 0.6 does not damp accelerations that alternate from step to step, and
/// turning feeds them where a wave runs through a block ten times in a step: kinetic energy grows by
/// thousands. Warns of dynamic parts with such a scheme in a frame that turns with the blocks, and names one
/// that may turn. Refuses dilation in dynamic steps of other schemes than those that damp most.
/// \param[in] may_turn  of each block: whether not all of it is held
void check_scheme(const Document& document, const Scene& scene, const NameTable& blocks,
                  const std::vector<bool>& may_turn, ProblemList& problems);

}  // namespace ddacontact::scene_format
