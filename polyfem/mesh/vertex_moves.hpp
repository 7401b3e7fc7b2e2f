/// \file Other positions for the vertices of a mesh.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <cstdint>
#include <functional>

namespace polyfem {

/// Moves each vertex inside the mesh at random, by up to `amount` of its shortest edge, less
/// where a cell around would cease to be simple, or convex (corners turning by 1e-2 at least) if it was. The
/// same seed gives the same bytes. 0 <= amount <= 1, else throws Error.
void perturb_inner_vertices(PolygonMesh& mesh, double amount, std::uint64_t seed = 1);

/// The mesh with each vertex x put at map(x). Throws Error when the result has a defect, be it from before:
/// see `require_valid`.
PolygonMesh mapped(PolygonMesh mesh, const std::function<Vec2(const Vec2&)>& map);

}  // namespace polyfem
