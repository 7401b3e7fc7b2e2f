/// \file The fields of a frame at points inside its blocks.
#pragma once

#include <ddacontact/output/cell_view.hpp>

namespace ddacontact {

/// Values at a list of points. What the frame does not hold has no columns or rows.
struct FrameValues {
  /// Room for `n` points.
  FrameValues(const Frame& frame, Index n);

  /// Sets the values of point `k` from its cell, the stress where that is looked at from this centre (the
  /// point itself: there).
  void set(const Frame& frame, const CellView& cell, const Vec2& point, const Vec2& centre, Index k);
  /// The same at a corner of the cell.
  void set_at_corner(const Frame& frame, const CellView& cell, int corner, const Vec2& centre, Index k);

  /// s1 and s2 of every point, a column each.
  Eigen::MatrixX2d principal_stresses() const;

  Eigen::Matrix3Xd displacement, velocity;  ///< x, y, 0 of each point
  Points strain_displacement;               ///< interpolated
  Eigen::MatrixX3d stress;                  ///< xx, yy, xy: a column each

 private:
  void set_stress(const CellView& cell, const Vec2& point, const Vec2& centre, Index k);
};

}  // namespace ddacontact
