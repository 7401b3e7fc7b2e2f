/// \file [[stage]] of a scene file: options, joints and blocks of each part of a run.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>
#include <ddacontact/scene/resolve_joints.hpp>

#include <vector>

namespace ddacontact::scene_format {

/// \param[in] scene  resolved but for its stages and joints
std::vector<StageDescription> resolve_stages(const Document& document, const Scene& scene,
                                             const NamedJoints& joints, const BlockTable& blocks,
                                             const NameTable& bolts, ProblemList& problems);

}  // namespace ddacontact::scene_format
