/// \file One cell of a frame as it lies, and what is inside it.
#pragma once

#include <ddacontact/output/frame.hpp>

namespace ddacontact {

/// Where a cell's stress is looked at for a point of it: as far from its centre as integration points reach.
/// Beyond, next to short edges, gradients of the shape functions mean nothing.
inline Vec2 stress_place(const Vec2& centre, const Vec2& point) {
  constexpr double reach = 0.9;
  return centre + reach * (point - centre);
}

/// The functions of the cell on its present corners. Where a corner has turned so far that Wachspress
/// functions cannot be used, mean value functions draw the cell.
class CellView {
 public:
  /// The frame must outlive this.
  CellView(const Frame& frame, int cell);

  const FrameCell& cell() const { return frame_.cells[cell_]; }
  const Points& corners() const { return corners_; }  ///< in the scene's coordinates
  /// The same relative to the first corner: exact far from the origin.
  Points local_corners() const { return corners_.colwise() - Vec2(corners_.col(0)); }
  const polyfem::Basis& basis() const { return *basis_; }

  /// The point of a corner: a column of what the frame has at points.
  int point(int corner) const { return frame_.corners(cell_)[corner]; }
  /// From vectors at all points, that at a point.
  Vec2 interpolate(const Points& of_points, const polyfem::ShapeValues& shape) const;
  /// The stress (xx, yy, xy) at a point, from the functions there.
  Vec3 stress(const polyfem::ShapeValues& shape) const;
  /// The area average, whatever the functions: they are linear on edges.
  Vec3 mean_stress() const;

 private:
  auto strain_displacement() const {
    return frame_.strain_displacement.middleCols(cell().corners.first, cell().corners.count);
  }
  Vec3 stress_of(const Mat2& gradient) const;

  const Frame& frame_;
  int cell_;
  Points corners_;
  const polyfem::Basis* basis_;
};

}  // namespace ddacontact
