#include <ddacontact/output/frame_values.hpp>

#include <polyfem/material/linear_elastic.hpp>

namespace ddacontact {

FrameValues::FrameValues(const Frame& frame, Index n) {
  const auto room_for = [n](Index columns) { return columns > 0 ? n : 0; };
  displacement.setZero(3, room_for(frame.displacement.cols()));
  velocity.setZero(3, room_for(frame.velocity.cols()));
  strain_displacement.setZero(2, room_for(frame.strain_displacement.cols()));
  stress.setZero(room_for(frame.strain_displacement.cols()), 3);
}

void FrameValues::set(const Frame& frame, const CellView& cell, const Vec2& point, const Vec2& centre,
                      Index k) {
  polyfem::ShapeValues shape;
  cell.basis()(cell.corners(), point, shape);
  if (displacement.cols() > 0) displacement.col(k).head<2>() = cell.interpolate(frame.displacement, shape);
  if (velocity.cols() > 0) velocity.col(k).head<2>() = cell.interpolate(frame.velocity, shape);
  if (stress.rows() == 0) return;
  const auto [first, count] = cell.cell().corners;
  strain_displacement.col(k) = frame.strain_displacement.middleCols(first, count) * shape.values;
  set_stress(cell, point, centre, k);
}

void FrameValues::set_at_corner(const Frame& frame, const CellView& cell, int corner, const Vec2& centre,
                                Index k) {
  const int point = cell.point(corner);
  if (displacement.cols() > 0) displacement.col(k).head<2>() = frame.displacement.col(point);
  if (velocity.cols() > 0) velocity.col(k).head<2>() = frame.velocity.col(point);
  if (stress.rows() == 0) return;
  strain_displacement.col(k) = frame.strain_displacement.col(cell.cell().corners.first + corner);
  set_stress(cell, cell.corners().col(corner), centre, k);
}

void FrameValues::set_stress(const CellView& cell, const Vec2& point, const Vec2& centre, Index k) {
  polyfem::ShapeValues shape;
  cell.basis()(cell.corners(), stress_place(centre, point), shape);
  stress.row(k) = cell.stress(shape);
}

Eigen::MatrixX2d FrameValues::principal_stresses() const {
  Eigen::MatrixX2d principal(stress.rows(), 2);
  for (Index k = 0; k < stress.rows(); ++k) {
    const polyfem::PrincipalStresses s = polyfem::principal_stresses(stress.row(k));
    principal.row(k) << s.s1, s.s2;
  }
  return principal;
}

}  // namespace ddacontact
