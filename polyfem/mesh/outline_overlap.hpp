/// \file Outlines that cross or lie within each other.
#pragma once

#include <polyfem/mesh/edge_defects.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace polyfem {

/// Two edges of the outlines of cells where these lie on each other: the edges cross, or follow upon each
/// other from bottom to top with their cells on the same side.
///
/// \param[in] outlines  edges of counter-clockwise cells on one side only. They must not touch but at common
///                      ends, see `touching_vertices`.
///
/// On any vertical line the plane is covered once at most if, from bottom to top, edges with the cell above
/// and edges with the cell below alternate. A sweep from left to right keeps the edges in that order; it ends
/// at the first overlap, after O(n log n) exact comparisons at most.
std::optional<std::pair<CellEdge, CellEdge>> find_overlap(const Points& vertices,
                                                          const std::vector<CellEdge>& outlines);

}  // namespace polyfem
