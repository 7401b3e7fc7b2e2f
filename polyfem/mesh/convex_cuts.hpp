/// \file Cuts concave cells into convex ones.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

namespace polyfem {

/// The mesh with every cell that has a corner turning by no more than `least_turn` (a sine) divided along
/// diagonals until each corner turns by more. Diagonals end at vertices, so neighbours are not touched. Of
/// the diagonals at the worst corner the one with the best angles at its ends is taken. A cell that cannot be
/// divided so (a triangle with a nearly straight corner) is left as it is.
PolygonMesh cut_into_convex(const PolygonMesh& mesh, double least_turn);

}  // namespace polyfem
