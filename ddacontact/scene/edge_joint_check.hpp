/// \file Edges that touch and name different joints.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

namespace ddacontact::scene_format {

/// Warns of blocks with edges that touch at the start and follow different joints: what acts between them
/// then depends on which vertex meets which edge.
void warn_of_two_joints_on_a_face(const Scene& scene, const BlockTable& blocks, ProblemList& problems);

}  // namespace ddacontact::scene_format
