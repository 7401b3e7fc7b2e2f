#include <ddacontact/output/frame_mesh.hpp>

#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/fan_subdivision.hpp>

#include <algorithm>
#include <numeric>

namespace ddacontact {

namespace {

FrameMesh mesh_with_room(const Frame& frame, Index n_points, Index n_corners, Index n_cells,
                         polyfem::VtkCell cell_type) {
  FrameMesh mesh{.points = Eigen::Matrix3Xd::Zero(3, n_points),
                 .connectivity = {},
                 .ends = {},
                 .cell_types = std::vector(static_cast<std::size_t>(n_cells), cell_type),
                 .first_point = {},
                 .block_of_point = {},
                 .block_of_cell = {},
                 .at_points = FrameValues(frame, n_points),
                 .at_cells = FrameValues(frame, n_cells)};
  mesh.connectivity.reserve(static_cast<std::size_t>(n_corners));
  mesh.ends.reserve(static_cast<std::size_t>(n_cells));
  mesh.block_of_point.reserve(static_cast<std::size_t>(n_points));
  mesh.block_of_cell.reserve(static_cast<std::size_t>(n_cells));
  return mesh;
}

std::vector<int> blocks_by_number_of_vertices(const Frame& frame) {
  std::vector<int> order(frame.blocks.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return frame.blocks[a].count < frame.blocks[b].count; });
  return order;
}

/// Adds the subdivision of one block behind what the mesh has.
void add_block(const Frame& frame, int block, const polyfem::FanSubdivision& fan, FrameMesh& mesh) {
  const auto outline = frame.outline(block);
  const Index first_point = static_cast<Index>(mesh.block_of_point.size()), n_points = fan.points.cols();
  mesh.first_point.push_back(static_cast<int>(first_point));
  mesh.points.middleCols(first_point, n_points).topRows<2>() = fan.points;
  mesh.block_of_point.insert(mesh.block_of_point.end(), static_cast<std::size_t>(n_points), block);
  polyfem::ShapeValues shape;
  for (int k = 0; k < n_points; ++k) {
    if (k < outline.cols()) {
      mesh.at_points.set_at_vertex(frame, block, k, first_point + k);
    } else {
      polyfem::wachspress(outline, fan.points.col(k), shape);
      mesh.at_points.set(frame, block, shape, first_point + k);
    }
  }
  for (const auto triangle : fan.triangles.colwise()) {
    for (int corner : triangle) mesh.connectivity.push_back(first_point + corner);
    polyfem::wachspress(outline, fan.points(Eigen::all, triangle).rowwise().mean(), shape);
    mesh.at_cells.set(frame, block, shape, static_cast<Index>(mesh.ends.size()));
    mesh.ends.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
    mesh.block_of_cell.push_back(block);
  }
}

}  // namespace

FrameMesh draw_outlines(const Frame& frame) {
  const Index n_points = frame.position.cols();
  FrameMesh mesh = mesh_with_room(frame, n_points, n_points, frame.n_blocks(), polyfem::VtkCell::polygon);
  mesh.points.topRows<2>() = frame.position;
  for (int b = 0; b < frame.n_blocks(); ++b) {
    const auto [first, count] = frame.blocks[b];
    mesh.first_point.push_back(first);
    mesh.block_of_point.insert(mesh.block_of_point.end(), static_cast<std::size_t>(count), b);
    for (int v = 0; v < count; ++v) mesh.at_points.set_at_vertex(frame, b, v, first + v);
  }
  polyfem::ShapeValues shape;
  for (int b : blocks_by_number_of_vertices(frame)) {
    const auto [first, count] = frame.blocks[b];
    for (int v = 0; v < count; ++v) mesh.connectivity.push_back(first + v);
    const Index cell = static_cast<Index>(mesh.ends.size());
    polyfem::wachspress(frame.outline(b), polyfem::area_moments(frame.outline(b)).centroid, shape);
    mesh.at_cells.set(frame, b, shape, cell);
    if (frame.mean_stress.cols() > 0) mesh.at_cells.stress.row(cell) = frame.mean_stress.col(b);
    mesh.ends.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
    mesh.block_of_cell.push_back(b);
  }
  return mesh;
}

FrameMesh draw_sub_triangles(const Frame& frame, int n) {
  const Index n_triangles = frame.position.cols() * n * n;
  const Index n_points = frame.position.cols() * n * (n + 1) / 2 + frame.n_blocks();
  FrameMesh mesh = mesh_with_room(frame, n_points, 3 * n_triangles, n_triangles, polyfem::VtkCell::triangle);
  for (int b = 0; b < frame.n_blocks(); ++b) {
    const Vec2 centroid = polyfem::area_moments(frame.outline(b)).centroid;
    add_block(frame, b, polyfem::subdivide_fan(frame.outline(b), centroid, n), mesh);
  }
  return mesh;
}

}  // namespace ddacontact
