#include <ddacontact/block/block.hpp>

#include <Eigen/LU>

#include <cmath>

namespace ddacontact {

Block::Block(const BlockMaterial& material, const PointsRef& outline)
    : material_(material),
      compliance_(material.elasticity.inverse()),
      reference_(outline),
      reference_area_(polyfem::signed_area(outline)),
      grid_(std::exp2(std::floor(std::log2(reference_area_) / 2))),
      moments_(polyfem::area_moments(outline)) {}

void Block::place(int index, int first_vertex, int first_unknown, int first_stress_point) {
  index_ = index;
  vertices_ = {first_vertex, n_vertices()};
  unknowns_ = {first_unknown, n_unknowns()};
  stress_points_ = {first_stress_point, n_stress_points()};
}

double Block::size() const {
  return std::sqrt(reference_area_);
}

Vec2 Block::grid_point(const Vec2& near) const {
  return grid_ * Vec2(std::round(near.x() / grid_), std::round(near.y() / grid_));
}

void Block::prepare(const BlockState& state) {
  const auto outline = state.position.middleCols(vertices_.first, vertices_.count);
  origin_ = state.origin.col(index_);
  moments_ = polyfem::area_moments(outline);
  prepare_shape(outline);
}

void Block::follow_with_origin(BlockState& state) const {
  auto outline = state.position.middleCols(vertices_.first, vertices_.count);
  const Vec2 mean = outline.rowwise().mean();
  if (mean.cwiseAbs().maxCoeff() < 4 * grid_) return;
  const Vec2 shift = grid_point(mean);
  outline.colwise() -= shift;
  state.origin.col(index_) += shift;
}

double Block::elastic_energy(const BlockState& state) const {
  const Tensors sigma = stress(state);
  double energy = 0;
  for (int q = 0; q < stress_points_.count; ++q)
    energy += integration_weights_[q] * sigma.col(q).dot(compliance_ * sigma.col(q)) / 2;
  return energy;
}

Points uniform_strain_displacement(const PointsRef& outline, const Vec2& centroid, const Vec3& strain) {
  Mat2 gradient;
  gradient << strain[0], strain[2] / 2, strain[2] / 2, strain[1];
  return gradient * (outline.colwise() - centroid);
}

}  // namespace ddacontact
