/// \file What a cell is drawn by: polygons that fans of triangles about their centroids fill.
#pragma once

#include <ddacontact/core/types.hpp>

#include <vector>

namespace ddacontact {

/// A polygon by the numbers of the cell's corners, counter-clockwise.
using CellPiece = std::vector<int>;

/// The cell itself where every triangle of an edge and the centroid has an area; else the triangles of its
/// corners. A cell that is not simple any more is left as it is.
std::vector<CellPiece> pieces_of(const PointsRef& corners);

/// The centroid of a piece, or the mean of its corners where it has no area.
Vec2 centre_of(const PointsRef& outline);

}  // namespace ddacontact
