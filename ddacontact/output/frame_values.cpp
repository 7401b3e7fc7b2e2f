#include <ddacontact/output/frame_values.hpp>

#include <polyfem/material/linear_elastic.hpp>

namespace ddacontact {

FrameValues::FrameValues(const Frame& frame, Index n) {
  const auto room_for = [n](Index columns) { return columns > 0 ? n : 0; };
  displacement.setZero(3, room_for(frame.displacement.cols()));
  velocity.setZero(3, room_for(frame.velocity.cols()));
  strain_displacement.resize(2, room_for(frame.strain_displacement.cols()));
  stress.resize(room_for(frame.strain_displacement.cols()), 3);
}

void FrameValues::set(const Frame& frame, int block, const polyfem::ShapeValues& shape, Index k) {
  const auto [first, count] = frame.blocks[block];
  if (displacement.cols() > 0)
    displacement.col(k).head<2>() = frame.displacement.middleCols(first, count) * shape.values;
  if (velocity.cols() > 0) velocity.col(k).head<2>() = frame.velocity.middleCols(first, count) * shape.values;
  if (stress.rows() == 0) return;
  strain_displacement.col(k) = frame.strain_displacement.middleCols(first, count) * shape.values;
  stress.row(k) = frame.stress(block, shape);
}

void FrameValues::set_at_vertex(const Frame& frame, int block, int vertex, Index k) {
  const Index column = frame.blocks[block].first + vertex;
  if (displacement.cols() > 0) displacement.col(k).head<2>() = frame.displacement.col(column);
  if (velocity.cols() > 0) velocity.col(k).head<2>() = frame.velocity.col(column);
  if (stress.rows() == 0) return;
  strain_displacement.col(k) = frame.strain_displacement.col(column);
  stress.row(k) = frame.stress_at_vertex(block, vertex);
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
