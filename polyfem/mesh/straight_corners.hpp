/// \file Bends corners that are nearly straight.
#pragma once

#include <polyfem/mesh/mesh_editor.hpp>

namespace polyfem {

/// Moves vertices of cells with a corner that turns by less than `wanted_turn` (a sine) a little towards the
/// middle of their neighbours, wherever that raises the least turn around; ends when nothing improves, at the
/// latest after 20 rounds.
void bend_straight_corners(MeshEditor& mesh, double wanted_turn);

}  // namespace polyfem
