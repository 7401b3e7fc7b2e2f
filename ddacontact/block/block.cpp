#include <ddacontact/block/block.hpp>

#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/geometry/validity.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace ddacontact {

Block::Block(const BlockMaterial& material, const PointsRef& points, int n_vertices)
    : material_(material),
      reference_(static_cast<std::size_t>(points.cols())),
      reference_area_(polyfem::signed_area(points.leftCols(n_vertices))),
      grid_(std::exp2(std::floor(std::log2(reference_area_) / 2))),
      n_vertices_(n_vertices) {
  Points::Map(reference_.front().data(), 2, points.cols()) = points;
}

void Block::number(int index, int first_point, int first_unknown, int first_stress_point,
                   int first_coordinate) {
  assert(index >= 0 && first_point >= 0 && first_unknown >= 0);
  assert(n_points() >= n_vertices() && n_vertices() >= 3);
  index_ = index;
  vertices_ = {first_point, n_vertices()};
  points_ = {first_point, n_points()};
  unknowns_ = {first_unknown, n_unknowns()};
  stress_points_ = {first_stress_point, n_stress_points()};
  coordinates_ = {first_coordinate, n_coordinates()};
}

Mat3 Block::compliance() const {
  return material_.elasticity.inverse();
}

double Block::furthest_vertex(const VectorXd& d) const {
  double furthest = 0;  // squared
  for (int v = 0; v < n_vertices(); ++v) furthest = std::max(furthest, vertex_map(v)(d).squaredNorm());
  return std::sqrt(furthest);
}

VectorXd Block::rotation(const BlockState& state) const {
  VectorXd unknowns(n_unknowns());
  rotation(state, unknowns);
  return unknowns;
}

RigidModes Block::rigid_modes(const BlockState& state) const {
  RigidModes modes;
  modes.resize(n_unknowns(), Eigen::NoChange);
  modes.leftCols<2>() = translations();
  rotation(state, modes.col(2));
  return modes;
}

Vec2 Block::grid_point(const Vec2& near) const {
  return grid_ * Vec2(std::round(near.x() / grid_), std::round(near.y() / grid_));
}

void Block::follow_with_origin(BlockState& state) const {
  auto points = points_.columns_of(state.position);
  const Vec2 mean = points.leftCols(n_vertices_).rowwise().mean();
  if (mean.cwiseAbs().maxCoeff() < 4 * grid_) return;
  const Vec2 shift = grid_point(mean);
  points.colwise() -= shift;
  state.origin.col(index_) += shift;
  if (state.coordinates.size() > 0 && coordinates_.count > 0)
    state.coordinates.segment<2>(coordinates_.first) -= shift;
}

double Block::elastic_energy(const BlockState& state) const {
  const Tensors sigma = stress(state);
  const Mat3 D_inverse = compliance();
  double energy = 0;
  for (int q = 0; q < stress_points_.count; ++q)
    energy += integration_weights()[q] * sigma.col(q).dot(D_inverse * sigma.col(q)) / 2;
  return energy;
}

std::vector<int> Block::part_unknowns(int /*part*/) const {
  std::vector<int> all(n_unknowns());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

VectorXd Block::point_weights(const Vec2& x) const {
  int nearest = 0;
  double least = inf;
  for (int c = 0; c < n_cells() && least > 0; ++c) {
    const Points outline = reference()(Eigen::all, cell(c).corners);
    const double distance = polyfem::distance_outside(outline, x);
    if (distance >= least) continue;
    least = distance;
    nearest = c;
  }
  const BlockCell in = cell(nearest);
  polyfem::ShapeValues shape;
  (*in.basis)(reference()(Eigen::all, in.corners), x, shape);
  VectorXd weights = VectorXd::Zero(n_points());
  weights(in.corners) = shape.values;
  return weights;
}

BlockCell Block::cell(int /*c*/) const {
  BlockCell cell{std::vector<int>(n_vertices_), &polyfem::suitable_basis(reference().leftCols(n_vertices_))};
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
