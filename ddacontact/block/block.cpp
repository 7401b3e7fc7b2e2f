#include <ddacontact/block/block.hpp>

#include <polyfem/basis/wachspress.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numeric>

namespace ddacontact {

Block::Block(const BlockMaterial& material, const PointsRef& outline)
    : material_(material),
      compliance_(material.elasticity.inverse()),
      reference_(outline),
      reference_area_(polyfem::signed_area(outline)),
      grid_(std::exp2(std::floor(std::log2(reference_area_) / 2))),
      n_vertices_(static_cast<int>(outline.cols())),
      moments_(polyfem::area_moments(outline)) {}

void Block::place(int index, int first_place, int first_unknown, int first_stress_point) {
  index_ = index;
  vertices_ = {first_place, n_vertices()};
  places_ = {first_place, n_places()};
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
  auto places = state.position.middleCols(places_.first, places_.count);
  const Vec2 mean = places.leftCols(n_vertices_).rowwise().mean();
  if (mean.cwiseAbs().maxCoeff() < 4 * grid_) return;
  const Vec2 shift = grid_point(mean);
  places.colwise() -= shift;
  state.origin.col(index_) += shift;
}

double Block::elastic_energy(const BlockState& state) const {
  const Tensors sigma = stress(state);
  double energy = 0;
  for (int q = 0; q < stress_points_.count; ++q)
    energy += integration_weights_[q] * sigma.col(q).dot(compliance_ * sigma.col(q)) / 2;
  return energy;
}

BlockCell Block::cell(int /*c*/) const {
  BlockCell cell{std::vector<int>(n_vertices_), &polyfem::wachspress};
  std::iota(cell.corners.begin(), cell.corners.end(), 0);
  return cell;
}

CellStress Block::cell_stress(const BlockState& state, int /*c*/) const {
  return {strain_displacement(state), material_.elasticity, Vec3::Zero()};
}

Points uniform_strain_displacement(const PointsRef& outline, const Vec2& centroid, const Vec3& strain) {
  Mat2 gradient;
  gradient << strain[0], strain[2] / 2, strain[2] / 2, strain[1];
  return gradient * (outline.colwise() - centroid);
}

}  // namespace ddacontact
