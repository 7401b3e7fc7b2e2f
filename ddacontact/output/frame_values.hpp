/// \file The fields of a frame at points inside its blocks.
#pragma once

#include <ddacontact/output/frame.hpp>

namespace ddacontact {

/// Values at a list of points. What the frame does not hold has no columns or rows.
struct FrameValues {
  /// Room for `n` points.
  FrameValues(const Frame& frame, Index n);

  /// Sets the values of point `k`, from the shape functions of its block there.
  void set(const Frame& frame, int block, const polyfem::ShapeValues& shape, Index k);
  /// The same at a vertex of the outline.
  void set_at_vertex(const Frame& frame, int block, int vertex, Index k);

  /// s1 and s2 of every point, a column each.
  Eigen::MatrixX2d principal_stresses() const;

  Eigen::Matrix3Xd displacement, velocity;  ///< x, y, 0 of each point
  Points strain_displacement;               ///< interpolated
  Eigen::MatrixX3d stress;                  ///< xx, yy, xy: a column each
};

}  // namespace ddacontact
