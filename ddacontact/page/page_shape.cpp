#include <ddacontact/page/page_shape.hpp>

#include <ddacontact/page/byte_text.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

constexpr double round_off = 1e-9;  // of a block's size

/// n - 2 triangles; those of a polygon that is not simple overlap.
polyfem::Triangles triangles_of(const Points& corners) {
  const Points local = corners.colwise() - Vec2(corners.col(0));
  const auto n = static_cast<int>(corners.cols());
  const bool is_convex = !polyfem::find_non_convex_corner(local);
  if (!is_convex && !polyfem::find_defect(local) && polyfem::signed_area(local) > 0)
    return polyfem::triangulate(local);
  polyfem::Triangles fan(3, n - 2);
  for (int k = 0; k < n - 2; ++k) fan.col(k) = Eigen::Vector3i(0, k + 1, k + 2);
  return fan;
}

bool same_cells(const std::vector<FrameCell>& a, const std::vector<FrameCell>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const FrameCell& x, const FrameCell& y) {
    return x.block == y.block && x.corners.count == y.corners.count;
  });
}

}  // namespace

Points reference_of(const Frame& frame) {
  if (frame.displacement.cols() != frame.position.cols()) return frame.position;
  return frame.position - frame.displacement;
}

PageShape::PageShape(const Frame& frame)
    : reference_(reference_of(frame)), frame_cells_(frame.cells), corner_points_(frame.corner_points) {
  std::size_t cell = 0;
  for (int b = 0; b < frame.n_blocks(); ++b) {
    const Range points = frame.points(b);
    points_.push_back(points);
    const std::size_t first = cell;
    while (cell < frame.cells.size() && frame.cells[cell].block == b) ++cell;
    cells_.push_back({static_cast<int>(first), static_cast<int>(cell - first)});
    const auto outline = frame.outline(b);
    sizes_.push_back((outline.rowwise().maxCoeff() - outline.rowwise().minCoeff()).norm());
  }
}

bool PageShape::fits(const Frame& frame) const {
  if (frame.position.cols() != reference_.cols() || !same_cells(frame.cells, frame_cells_) ||
      frame.corner_points != corner_points_)
    return false;
  if (frame.displacement.cols() != frame.position.cols()) return true;
  const Points change = reference_of(frame) - reference_;
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const auto of_block = change.middleCols(points_[b].first, points_[b].count);
    const auto moved = frame.displacement.middleCols(points_[b].first, points_[b].count);
    const double scale = sizes_[b] + moved.cwiseAbs().maxCoeff() + reference_.col(points_[b].first).norm();
    if (of_block.cwiseAbs().maxCoeff() > round_off * scale) return false;
  }
  return true;
}

std::string PageShape::bytes(const Frame& frame, const Vec2& centre) const {
  std::string bytes;
  append_integer(frame.n_blocks(), bytes);
  for (std::size_t b = 0; b < frame.blocks.size(); ++b)
    for (const int number : {frame.blocks[b].count, points_[b].count, cells_[b].count, frame.materials[b]})
      append_integer(number, bytes);
  for (int c = 0; c < frame.n_cells(); ++c) {
    const std::span<const int> points = frame.corners(c);
    append_integer(static_cast<int>(points.size()), bytes);
    int before = points_[static_cast<std::size_t>(frame.cells[static_cast<std::size_t>(c)].block)].first;
    Points corners(2, static_cast<Index>(points.size()));
    for (std::size_t k = 0; k < points.size(); ++k) {
      append_integer(points[k] - before, bytes);
      before = points[k];
      corners.col(static_cast<Index>(k)) = frame.position.col(points[k]);
    }
    for (const int corner : triangles_of(corners).reshaped()) append_integer(corner, bytes);
  }
  const Eigen::Matrix2Xf relative = (reference_.colwise() - centre).cast<float>();
  bytes.append(reinterpret_cast<const char*>(relative.data()),
               static_cast<std::size_t>(relative.size()) * sizeof(float));
  return bytes;
}

}  // namespace ddacontact
