#include <ddacontact/classic/affine_block.hpp>

#include <Eigen/LU>

namespace ddacontact {

namespace {

constexpr int n_strains = Tensors::RowsAtCompileTime;

/// T of (3) at distance r from the centroid.
Transformation transformation(const Vec2& r) {
  Transformation T;
  T << 1, 0, -r.y(), r.x(), 0, r.y() / 2,  //
      0, 1, r.x(), 0, r.y(), r.x() / 2;
  return T;
}

/// Displacement gradient that goes with an unknown.
Mat2 gradient(int unknown) {
  Mat2 G;
  G << transformation(Vec2::UnitX()).col(unknown), transformation(Vec2::UnitY()).col(unknown);
  return G;
}

}  // namespace

AffineBlock::AffineBlock(const BlockMaterial& material, const PointsRef& outline,
                         const std::optional<ControlVertices>& control)
    : IncrementalBlock(material, outline), control_(control), vertex_maps_(outline.cols()) {
  AffineBlock::take_shape(outline);
}

VectorXd AffineBlock::unknown_lengths() const {
  VectorXd lengths = VectorXd::Ones(n_unknowns());
  if (!control_) lengths.tail(n_unknowns() - 2).setConstant(size());
  return lengths;
}

void AffineBlock::take_shape(const PointsRef& outline) {
  moments_ = polyfem::area_moments(outline);
  const Vec2& centroid = moments_.centroid;
  Mat6 displacements = Mat6::Identity();  // of the control vertices, if there are any, by the unknowns (1)
  basis_ = displacements;
  if (control_) {
    for (std::size_t k = 0; k < control_->x.size(); ++k) {
      displacements.row(2 * k) = transformation(outline.col(control_->x[k]) - centroid).row(0);
      displacements.row(2 * k + 1) = transformation(outline.col(control_->y[k]) - centroid).row(1);
    }
    basis_ = displacements.inverse();
  }
  translations_ = displacements.leftCols<2>();
  rotation_ = displacements.col(2);
  for (int v = 0; v < n_vertices(); ++v) {
    const Transformation map = transformation(outline.col(v) - centroid) * basis_;
    for (int k = 0; k < n_unknowns(); ++k) vertex_maps_[v][k] = {k, map.col(k)};
  }

  const double area = moments_.area;
  Mat6 K = Mat6::Zero();
  K.bottomRightCorner<n_strains, n_strains>() = area * material().elasticity;
  stiffness_ = basis_.transpose() * K * basis_;

  Mat6 M = Mat6::Zero();  // integral of T^T T: r = x - centroid integrates to zero
  M.topLeftCorner<2, 2>() = area * Mat2::Identity();
  for (int i = 2; i < n_unknowns(); ++i)
    for (int j = 2; j < n_unknowns(); ++j)
      M(i, j) = (gradient(i) * moments_.second * gradient(j).transpose()).trace();
  mass_ = density() * basis_.transpose() * M * basis_;

  integration_weights_ = VectorXd::Constant(1, area);
}

PointMap AffineBlock::vertex_map(int vertex) const {
  return PointMap(unknowns().first, vertex_maps_[vertex]);
}

void AffineBlock::add_stress_forces(const BlockState& state, VectorXd& F) const {
  const Vec3 stress = state.stress.col(stress_points().first);
  unknowns().of(F) -= moments_.area * basis_.bottomRows<n_strains>().transpose() * stress;
}

void AffineBlock::add_body_force(const Vec2& b, VectorXd& F) const {
  unknowns().of(F) += reference_area() * basis_.topRows<2>().transpose() * b;
}

void AffineBlock::add_stress(const VectorXd& d, Tensors& stress) const {
  const Vec3 strain = basis_.bottomRows<n_strains>() * unknowns().of(d);
  stress.col(stress_points().first) += material().elasticity * strain;
}

Points AffineBlock::strain_displacement(const BlockState& state) const {
  const Vec3 strain = compliance() * state.stress.col(stress_points().first);
  return uniform_strain_displacement(outline(state), moments(state).centroid, strain);
}

}  // namespace ddacontact
