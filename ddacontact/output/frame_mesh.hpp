/// \file Points and cells that draw the blocks of a frame, with the frame's fields on them.
#pragma once

#include <ddacontact/output/frame_values.hpp>
#include <polyfem/io/vtu_file.hpp>

#include <vector>

namespace ddacontact {

/// Blocks share no points. Each block's outline vertices are the first of its points, in their order.
struct FrameMesh {
  Eigen::Matrix3Xd points;                       ///< x, y, 0
  std::vector<std::int64_t> connectivity, ends;  ///< of cells, as .vtu files have them
  std::vector<polyfem::VtkCell> cell_types;
  std::vector<int> first_point;  ///< of each block
  std::vector<int> block_of_point, block_of_cell;
  FrameValues at_points, at_cells;
};

/// Each block a polygon; polygons sorted by their number of vertices, which some readers need. Values of a
/// cell are those at the block's centroid, its stress the block's mean.
FrameMesh draw_outlines(const Frame& frame);

/// Each block's fan of triangles about its centroid, each triangle split into n x n; values of a cell are
/// those at its centroid.
FrameMesh draw_sub_triangles(const Frame& frame, int n);

}  // namespace ddacontact
