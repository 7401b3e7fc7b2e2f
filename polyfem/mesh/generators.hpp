/// \file Meshes of a rectangle in regular cells, and what makes other meshes of them.
///
/// All fill the rectangle from corner `low` to corner `high` with n_x cells across and n_y upwards (more or
/// less where it says so), rows from the bottom, cells in a row from the left. Its corners are vertices to
/// the bit, and coordinates on its sides are exact. They throw Error for numbers below those named, for a
/// rectangle without area, and for cells below 1e-12 of the coordinates. For irregular cells see `voronoi`,
/// for other shapes `mapped`.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

namespace polyfem {

/// Equal rectangles.
PolygonMesh rectangles(const Vec2& low, const Vec2& high, int n_x, int n_y);

/// Which way rectangles are cut into triangles.
enum class Diagonals {
  one_way,     ///< all from the lower left corner to the upper right one
  alternating  ///< every second one the other way, like a chessboard
};
/// Equal rectangles cut in two along a diagonal: 2 n_x n_y triangles.
PolygonMesh triangles(const Vec2& low, const Vec2& high, int n_x, int n_y,
                      Diagonals diagonals = Diagonals::alternating);

/// Hexagons, points up, cut to fit: every second row starts and ends with half a cell (n_x + 1 cells),
/// and bottom and top are flat. All are strictly convex with the same area, half cells apart. Regular where
/// the cells' width is 2 / sqrt(3) of the rows' height.
PolygonMesh hexagons(const Vec2& low, const Vec2& high, int n_x, int n_y);

/// Rectangles in running bond, every second row starting and ending with half a cell. Inside the mesh each
/// has the corners of its neighbours as vertices halfway along its sides: straight corners.
PolygonMesh bricks(const Vec2& low, const Vec2& high, int n_x, int n_y);

/// The left half in n_x x n_y rectangles, the right one in rectangles of half their sides: the cells at the
/// middle of the left half's right column have a straight corner each.
PolygonMesh rectangles_of_two_sizes(const Vec2& low, const Vec2& high, int n_x, int n_y);

/// Arrowheads: rectangles whose inner vertical sides are bent to the right by `depth` of the cells' width
/// halfway up, 0 < depth < 1. All but those of the first column are concave there. n_x >= 2.
PolygonMesh chevrons(const Vec2& low, const Vec2& high, int n_x, int n_y, double depth = 0.5);

}  // namespace polyfem
