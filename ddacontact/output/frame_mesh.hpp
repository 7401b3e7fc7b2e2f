/// \file Points and cells that draw the blocks of a frame, with the frame's fields on them.
#pragma once

#include <ddacontact/output/frame_values.hpp>
#include <polyfem/io/vtu_file.hpp>

#include <cstdint>
#include <vector>

namespace ddacontact {

/// Blocks share no points. The points of a block come first, in their order, and serve the first of its cells
/// that has them as corners; other cells have points of their own there.
struct FrameMesh {
  Eigen::Matrix3Xd points;                       ///< x, y, 0
  std::vector<std::int64_t> connectivity, ends;  ///< of cells, as .vtu files have them
  std::vector<polyfem::VtkCell> cell_types;
  std::vector<int> first_point;   ///< of each block
  std::vector<int> corner_point;  ///< the point of each corner of Frame::cells
  std::vector<int> block_of_point, block_of_cell;
  FrameValues at_points, at_cells;
};

/// Each cell of the blocks a polygon; polygons sorted by their number of vertices, which some readers need.
/// Values of a polygon are those at its centroid, its stress the average over it.
FrameMesh draw_cells(const Frame& frame);

/// Each cell's fan of triangles about its centroid, or the fans of its pieces where it needs several, each
/// triangle split into n x n; values of a triangle are those at its centroid.
FrameMesh draw_sub_triangles(const Frame& frame, int n);

}  // namespace ddacontact
