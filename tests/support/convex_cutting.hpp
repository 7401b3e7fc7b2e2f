/// \file Convex polygons cut by lines, so that pieces on both sides of an edge get the same vertices to the
/// last bit.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace support {

using polyfem::Points;
using polyfem::Vec2;

struct Line {
  Vec2 through{0, 0}, direction{1, 0};
  double left(const Vec2& point) const { return polyfem::cross(direction, point - through); }
};

/// What is too small or too sharp to be a block.
struct Sliver {
  double area = 0;   ///< less is a sliver, m2
  double angle = 0;  ///< a corner sharper is one, radians
};
bool is_sliver(const Points& polygon, const Sliver& sliver);

/// The part of a convex counter-clockwise polygon on the left of a line; without columns when there is none.
/// An edge gives the same point whichever of the polygons beside it is cut.
Points left_of(const Points& polygon, const Line& line);

/// Every polygon cut in two by the line, save those where a piece would be a sliver: there the line has a
/// gap.
std::vector<Points> cut(const std::vector<Points>& polygons, const Line& line, const Sliver& sliver);

/// Vertices closer than `distance` to one before them take its place.
void merge_vertices(std::vector<Points>& polygons, double distance);

}  // namespace support
