/// \file Takes short edges out of a mesh.
#pragma once

#include <polyfem/mesh/mesh_editor.hpp>

namespace polyfem {

/// Collapses edges shorter than `shortest`, the shortest first, as far as every cell around keeps turning by
/// `wanted_turn` (or as much as it did); an edge whose collapse would break that stays. A triangle with such
/// an edge vanishes, but only while there are more than `least_cells` cells.
void collapse_short_edges(MeshEditor& mesh, double shortest, double wanted_turn, int least_cells);

}  // namespace polyfem
