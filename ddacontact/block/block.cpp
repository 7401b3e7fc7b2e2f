#include <ddacontact/block/block.hpp>

#include <Eigen/LU>

#include <cmath>

namespace ddacontact {

Block::Block(const BlockMaterial& material, const PointsRef& outline)
    : material_(material),
      compliance_(material.elasticity.inverse()),
      reference_(outline),
      reference_area_(polyfem::signed_area(outline)),
      moments_(polyfem::area_moments(outline)) {}

void Block::place(int first_vertex, int first_unknown, int first_stress_point) {
  vertices_ = {first_vertex, n_vertices()};
  unknowns_ = {first_unknown, n_unknowns()};
  stress_points_ = {first_stress_point, n_stress_points()};
}

double Block::size() const {
  return std::sqrt(reference_area_);
}

void Block::prepare(const BlockState& state) {
  const auto outline = state.position.middleCols(vertices_.first, vertices_.count);
  moments_ = polyfem::area_moments(outline);
  prepare_shape(outline);
}

double Block::elastic_energy(const BlockState& state) const {
  double energy = 0;
  for (int q = 0; q < stress_points_.count; ++q) {
    const Vec3 stress = state.stress.col(stress_points_.first + q);
    energy += integration_weights_[q] * stress.dot(compliance_ * stress) / 2;
  }
  return energy;
}

Points uniform_strain_displacement(const PointsRef& outline, const Vec2& centroid, const Vec3& strain) {
  Mat2 gradient;
  gradient << strain[0], strain[2] / 2, strain[2] / 2, strain[1];
  return gradient * (outline.colwise() - centroid);
}

}  // namespace ddacontact
