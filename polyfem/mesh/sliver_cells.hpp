/// \file Slivers among the cells of a domain: found, and merged into their neighbours.
#pragma once

#include <polyfem/mesh/cut_cells.hpp>

#include <functional>
#include <vector>

namespace polyfem {

/// Which cells are slivers.
struct SliverLimits {
  double area = 1e-3;  ///< smaller ones, of the mean area of all cells
  double angle = 5;    ///< those with a sharper corner, degrees
};

/// Cells below one of the limits, the smallest first.
std::vector<int> find_slivers(const CutCells& cells, const SliverLimits& limits);

/// Merges slivers into the neighbour with the longest common border, where the two make one simple polygon
/// and, of cells that are slivers by their angle alone, one without a new sharp corner. Others stay. Never
/// across edges whose mark is not to be `opened`. Returns how many were merged.
int merge_slivers(CutCells& cells, const SliverLimits& limits, const std::function<bool(int mark)>& opened);

}  // namespace polyfem
