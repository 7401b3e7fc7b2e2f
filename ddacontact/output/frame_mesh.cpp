#include <ddacontact/output/frame_mesh.hpp>

#include <ddacontact/output/cell_pieces.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/fan_subdivision.hpp>

#include <algorithm>
#include <numeric>

namespace ddacontact {

namespace {

/// Where a mesh has its points.
struct PointNumbers {
  Index count = 0;
  std::vector<Index> first_inner;  ///< of the points inside each cell
};

/// Sets `first_point` and `corner_point`.
/// \param[in] n_inner  how many points there are inside each cell
PointNumbers number_points(const Frame& frame, const std::vector<int>& n_inner, FrameMesh& mesh) {
  std::vector<bool> used(static_cast<std::size_t>(frame.position.cols()), false);
  PointNumbers numbers;
  Index& n_points = numbers.count;
  std::size_t c = 0;
  mesh.corner_point.reserve(frame.corner_points.size());
  for (int b = 0; b < frame.n_blocks(); ++b) {
    const Range points = frame.points(b);
    const Index first_point = n_points;
    mesh.first_point.push_back(static_cast<int>(first_point));
    n_points += points.count;
    for (; c < frame.cells.size() && frame.cells[c].block == b; ++c) {
      for (int point : frame.corners(static_cast<int>(c))) {
        mesh.corner_point.push_back(
            static_cast<int>(used[point] ? n_points++ : first_point + point - points.first));
        used[point] = true;
      }
      numbers.first_inner.push_back(n_points);
      n_points += n_inner[c];
    }
  }
  return numbers;
}

/// Makes room for all points, and sets those of the outlines.
void make_points(const Frame& frame, Index n_points, FrameMesh& mesh) {
  mesh.points.setZero(3, n_points);
  mesh.at_points = FrameValues(frame, n_points);
  for (int b = 0; b < frame.n_blocks(); ++b) {
    const Range points = frame.points(b);
    mesh.points.middleCols(mesh.first_point[b], points.count).topRows<2>() =
        frame.position.middleCols(points.first, points.count);
    const Index end = b + 1 < frame.n_blocks() ? mesh.first_point[b + 1] : n_points;
    mesh.block_of_point.resize(static_cast<std::size_t>(end), b);
  }
}

void set_corners(const Frame& frame, const CellView& view, const std::vector<CellPiece>& pieces,
                 FrameMesh& mesh) {
  for (const CellPiece& piece : pieces) {
    const Vec2 centre = centre_of(view.corners()(Eigen::all, piece));
    for (int k : piece) {
      const int point = mesh.corner_point[view.cell().corners.first + k];
      mesh.points.col(point).head<2>() = view.corners().col(k);
      mesh.at_points.set_at_corner(frame, view, k, centre, point);
    }
  }
}

void end_cell(int block, FrameMesh& mesh) {
  mesh.ends.push_back(static_cast<std::int64_t>(mesh.connectivity.size()));
  mesh.block_of_cell.push_back(block);
}

/// Adds the fan of a piece; its points but for the corners are those from `first_point` on.
/// \return  how many points these are
Index add_fan(const Frame& frame, const CellView& view, const CellPiece& piece, int n, Index first_point,
              FrameMesh& mesh) {
  const Points outline = view.corners()(Eigen::all, piece);
  const Vec2 centre = centre_of(outline);
  const auto fan = polyfem::subdivide_fan(outline, centre, n);
  const auto n_corners = static_cast<int>(piece.size());
  const auto point = [&](int k) -> Index {
    return k < n_corners ? mesh.corner_point[view.cell().corners.first + piece[k]]
                         : first_point + k - n_corners;
  };
  for (int k = n_corners; k < fan.points.cols(); ++k) {
    mesh.points.col(point(k)).head<2>() = fan.points.col(k);
    mesh.at_points.set(frame, view, fan.points.col(k), centre, point(k));
  }
  for (const auto triangle : fan.triangles.colwise()) {
    for (int corner : triangle) mesh.connectivity.push_back(point(corner));
    const Vec2 middle = fan.points(Eigen::all, triangle).rowwise().mean();
    mesh.at_cells.set(frame, view, middle, middle, static_cast<Index>(mesh.ends.size()));
    end_cell(view.cell().block, mesh);
  }
  return fan.points.cols() - n_corners;
}

FrameMesh empty_mesh(const Frame& frame) {
  return {.points = {},
          .connectivity = {},
          .ends = {},
          .cell_types = {},
          .first_point = {},
          .corner_point = {},
          .block_of_point = {},
          .block_of_cell = {},
          .at_points = FrameValues(frame, 0),
          .at_cells = FrameValues(frame, 0)};
}

/// Whether a block is one cell: then its mean stress is that of its own integration points.
bool is_alone(const Frame& frame, int cell) {
  const auto of_block = [&](int other) {
    return other >= 0 && other < frame.n_cells() && frame.cells[other].block == frame.cells[cell].block;
  };
  return !of_block(cell - 1) && !of_block(cell + 1);
}

}  // namespace

FrameMesh draw_cells(const Frame& frame) {
  FrameMesh mesh = empty_mesh(frame);
  make_points(frame, number_points(frame, std::vector(frame.cells.size(), 0), mesh).count, mesh);
  mesh.cell_types.assign(frame.cells.size(), polyfem::VtkCell::polygon);
  mesh.at_cells = FrameValues(frame, frame.n_cells());
  mesh.connectivity.reserve(frame.corner_points.size());
  std::vector<int> order(frame.cells.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return frame.cells[a].corners.count < frame.cells[b].corners.count; });
  for (int c : order) {
    const CellView view(frame, c);
    const auto [first, count] = view.cell().corners;
    const int block = view.cell().block;
    set_corners(frame, view, pieces_of(view.corners()), mesh);
    for (int k = 0; k < count; ++k) mesh.connectivity.push_back(mesh.corner_point[first + k]);
    const Index row = static_cast<Index>(mesh.ends.size());
    const Vec2 centre = centre_of(view.corners());
    mesh.at_cells.set(frame, view, centre, centre, row);
    if (frame.mean_stress.cols() > 0)
      mesh.at_cells.stress.row(row) =
          is_alone(frame, c) ? Vec3(frame.mean_stress.col(block)) : view.mean_stress();
    end_cell(block, mesh);
  }
  return mesh;
}

FrameMesh draw_sub_triangles(const Frame& frame, int n) {
  FrameMesh mesh = empty_mesh(frame);
  std::vector<std::vector<CellPiece>> pieces;
  std::vector<int> n_inner;
  Index n_triangles = 0;
  for (int c = 0; c < frame.n_cells(); ++c) {
    n_inner.push_back(0);
    for (const CellPiece& piece : pieces.emplace_back(pieces_of(CellView(frame, c).corners()))) {
      const auto n_corners = static_cast<int>(piece.size());
      n_inner.back() += n_corners * (n * (n + 1) / 2 - 1) + 1;
      n_triangles += n_corners * n * n;
    }
  }
  const PointNumbers numbers = number_points(frame, n_inner, mesh);
  make_points(frame, numbers.count, mesh);
  mesh.cell_types.assign(static_cast<std::size_t>(n_triangles), polyfem::VtkCell::triangle);
  mesh.at_cells = FrameValues(frame, n_triangles);
  mesh.connectivity.reserve(static_cast<std::size_t>(3 * n_triangles));
  for (int c = 0; c < frame.n_cells(); ++c) {
    const CellView view(frame, c);
    set_corners(frame, view, pieces[c], mesh);
    Index first_point = numbers.first_inner[c];
    for (const CellPiece& piece : pieces[c]) first_point += add_fan(frame, view, piece, n, first_point, mesh);
  }
  return mesh;
}

}  // namespace ddacontact
