/// \file Whether the faces that a scene lets crush have vertices at their ends alone.
#pragma once

#include <ddacontact/scene/resolve_blocks.hpp>

namespace ddacontact::scene_format {

/// Warns of a vertex within a straight face, which bears whatever comes: strength in compression moves the
/// forces of corners away from the ends of a face. All outlines must be valid.
void warn_of_vertices_in_crushed_faces(const Document& document, const BlockTable& blocks,
                                       ProblemList& problems);

}  // namespace ddacontact::scene_format
