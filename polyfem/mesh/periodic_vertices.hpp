/// \file Which vertices of a periodic cell are the same point of the pattern.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <array>
#include <vector>

namespace polyfem {

/// Pairs (vertex, vertex moved by `period`) of the boundary, ordered by the first. Throws Error where a
/// vertex moved by the period comes to lie on the boundary's line but on no vertex: both sides need the same
/// vertices.
/// \param[in] tolerance  how far apart the two may be, over the length of the period
std::vector<std::array<int, 2>> periodic_vertices(const PolygonMesh& mesh, const Vec2& period,
                                                  double tolerance = 1e-9);

}  // namespace polyfem
