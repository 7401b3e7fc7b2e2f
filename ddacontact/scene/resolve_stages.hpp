/// \file [[stage]] of a scene file: options, joints and blocks of each part of a run.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>
#include <ddacontact/scene/resolve_joints.hpp>

#include <vector>

namespace ddacontact::scene_format {

/// \param[in] descriptions  of the blocks
/// \param[in] method        of the scene, resolved
std::vector<StageDescription> resolve_stages(const Document& document, const NamedJoints& joints,
                                             const BlockTable& blocks,
                                             const std::vector<BlockDescription>& descriptions,
                                             const NameTable& bolts, ContactMethod method,
                                             ProblemList& problems);

}  // namespace ddacontact::scene_format
