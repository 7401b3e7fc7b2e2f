/// \file What does not change of the blocks while a run is shown: cells, triangles, reference positions.
#pragma once

#include <ddacontact/output/frame.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// The reference positions of a frame's points: where they were without the displacements it holds; where it
/// holds none, where they are.
Points reference_of(const Frame& frame);

/// Cells and reference positions that several frames share.
class PageShape {
 public:
  explicit PageShape(const Frame& frame);

  /// Whether the frame has the same cells on the same reference positions, up to round-off.
  bool fits(const Frame& frame) const;
  /// Of all points.
  const Points& reference() const { return reference_; }
  /// The points of each block, and its cells.
  const std::vector<Range>& points() const { return points_; }
  const std::vector<Range>& cells() const { return cells_; }
  /// The diagonal of each block's box, m.
  const std::vector<double>& sizes() const { return sizes_; }

  /// As the page reads it: integers (`append_integer`) for blocks, cells and their triangles, then the
  /// reference positions relative to `centre`, x and y of each point, as little-endian 32-bit numbers.
  std::string bytes(const Frame& frame, const Vec2& centre) const;

 private:
  Points reference_;
  std::vector<FrameCell> frame_cells_;
  std::vector<int> corner_points_;
  std::vector<Range> points_, cells_;
  std::vector<double> sizes_;
};

}  // namespace ddacontact
