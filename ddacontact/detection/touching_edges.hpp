/// \file Where edges of two polygons lie on each other.
#pragma once

#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/core/types.hpp>

#include <vector>

namespace ddacontact {

/// Edges lie on each other within this part of the smaller block's size, as contacts at the start do.
inline constexpr double edges_touch = coincidence;

/// A part of an edge of one polygon that lies on an edge of another.
struct TouchingEdges {
  polyfem::Index edge, other;
  double from, to;  ///< in fractions of `edge`
};

/// All parts of edges of two polygons that lie within `near` (m) of each other, along more than that.
std::vector<TouchingEdges> touching_edges(const polyfem::PointsRef& polygon, const polyfem::PointsRef& other,
                                          double near);

}  // namespace ddacontact
