/// \file Separate polygons to a mesh with shared vertices.
#pragma once

#include <polyfem/mesh/clipped_diagram.hpp>
#include <polyfem/mesh/polygon_mesh.hpp>

namespace polyfem {

/// Corners within `tolerance` of each other become one vertex, at the place of the first; what is left with
/// fewer than three corners is dropped. Corners must be either well within the tolerance or well beyond it.
PolygonMesh weld(const Rings& rings, double tolerance);

}  // namespace polyfem
