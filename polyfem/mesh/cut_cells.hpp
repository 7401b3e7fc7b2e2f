/// \file A domain cut into cells by lines.
#pragma once

#include <polyfem/mesh/line_noding.hpp>

#include <vector>

namespace polyfem {

/// A simple polygon, counter-clockwise. `marks[k]` is that of the line between corners k and k + 1.
struct CutCell {
  std::vector<int> corners, marks;
};

/// Cells that share their vertices and fill the domain.
struct CutCells {
  std::vector<Vec2> vertices;
  std::vector<CutCell> cells;
  double grid = 0;       ///< vertices lie on multiples of it, those on straight lines but for so much
  int n_dangling = 0;    ///< pieces of lines longer than thrice the snap that divided nothing: taken out
  int n_connecting = 0;  ///< lines added so that no cell surrounds others

  Points outline(const CutCell& cell) const;
};

/// The mark of edges on the outline of the domain.
inline constexpr int outline_mark = -1;
/// The mark of lines added so that no cell surrounds others.
inline constexpr int connecting_mark = -2;

/// Cuts a domain along lines. Ends that divide nothing are taken out. Cells that another one surrounds, or
/// touches in one vertex, are joined to what is left and right of them by horizontal lines.
///
/// Neighbours share every vertex on their common border, those where lines end on it too (T-vertices). The
/// domain's corners are vertices, to the bit.
///
/// \param[in] domain  simple, in either orientation
/// \param[in] lines   with marks >= 0; where they overlap, the first counts. They may reach beyond the domain
/// \param[in] snap    vertices nearer to each other become one, of the domain's outline where one is; 0: none
CutCells cut_cells(const PointsRef& domain, const std::vector<Segment>& lines, double snap);

/// The cell beyond each edge of each cell; -1 on the outline of the domain.
std::vector<std::vector<int>> neighbours(const CutCells& cells);

/// Leaves out corners that turn by less than 1e-9 (a sine), or lie as near to a straight line as the grid
/// lets them, between edges of the same mark.
/// \param[in] keep_shared  a vertex that is a corner of some cell stays one of all
/// Returns how many corners that others need were left out: T-vertices.
int drop_straight_corners(CutCells& cells, bool keep_shared);

}  // namespace polyfem
