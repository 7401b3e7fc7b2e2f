/// \file A simple polygon cut into triangles at its vertices.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// Triangles by the vertices of a polygon, three indices a column, counter-clockwise.
using Triangles = Eigen::Matrix<int, 3, Eigen::Dynamic>;

/// The n - 2 triangles of a simple counter-clockwise polygon by cutting off ears, those with the largest
/// smallest angle first. Decided exactly: every triangle has an area, also where vertices lie on straight
/// lines, no triangle contains a vertex but its corners, and together they fill the polygon. About O(n^2).
/// Throws Error when the polygon has fewer than three vertices, or no ear left: then it is not simple, or not
/// counter-clockwise.
Triangles triangulate(const PointsRef& polygon);

}  // namespace polyfem
