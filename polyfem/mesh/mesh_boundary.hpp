/// \file Parts of a mesh's boundary, to hold or to load.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <array>
#include <functional>
#include <vector>

namespace polyfem {

/// A part of the plane: whether a point belongs to it.
using Region = std::function<bool(const Vec2&)>;

/// The boundary edges that lie in a region with both ends and their middle.
std::vector<std::array<int, 2>> boundary_edges(const PolygonMesh& mesh, const Region& region);

/// The vertices of the boundary that lie in a region, ascending.
std::vector<int> boundary_vertices(const PolygonMesh& mesh, const Region& region);

/// All vertices of the boundary, ascending.
std::vector<int> boundary_vertices(const PolygonMesh& mesh);

}  // namespace polyfem
