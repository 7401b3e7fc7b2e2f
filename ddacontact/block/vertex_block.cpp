#include <ddacontact/block/vertex_block.hpp>

#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/soundness.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <Eigen/Cholesky>

#include <array>

namespace ddacontact {

using polyfem::GradientCorrection;
using polyfem::TriangleRule;

namespace {
constexpr double negligible_stiffness = 1e-13;  // of the mean diagonal entry
}

VertexBlock::VertexBlock(const BlockMaterial& material, const PointsRef& outline,
                         const Integration& integration)
    : Block(material, outline), integration_(integration) {}

int VertexBlock::n_stress_points() const {
  return n_vertices() * static_cast<int>(integration_.triangle_rule->weights.size());
}

void VertexBlock::prepare_shape(const PointsRef& outline) {
  tabulate(outline, *integration_.triangle_rule, polyfem::wachspress, integration_.correction, element_);
  polyfem::stiffness(element_, material().elasticity, stiffness_);
  polyfem::mass(element_, mass_);
  mass_ *= current_density();
  polyfem::shape_integrals(element_, shape_integrals_);
  integration_weights_ = element_.rule.weights;

  rigid_modes_.resize(n_unknowns(), 3);
  for (int i = 0; i < n_vertices(); ++i) {
    const Vec2 r = outline.col(i) - moments().centroid;
    rigid_modes_.row(2 * i) << 1, 0, -r.y();
    rigid_modes_.row(2 * i + 1) << 0, 1, r.x();
  }
}

PointMap VertexBlock::vertex_map(int vertex) const {
  PointMap map;
  map.add(unknowns().first + 2 * vertex, Vec2::UnitX());
  map.add(unknowns().first + 2 * vertex + 1, Vec2::UnitY());
  return map;
}

void VertexBlock::add_stress_forces(const BlockState& state, VectorXd& F) const {
  VectorXd f(n_unknowns());
  polyfem::stress_forces(element_, state.stress.middleCols(stress_points().first, stress_points().count), f);
  F.segment(unknowns().first, unknowns().count) -= f;
}

void VertexBlock::add_body_force(const Vec2& b, VectorXd& F) const {
  const Vec2 current = b * (reference_area() / moments().area);
  for (int i = 0; i < n_vertices(); ++i)
    F.segment<2>(unknowns().first + 2 * i) += shape_integrals_[i] * current;
}

void VertexBlock::add_stress(const VectorXd& d, Tensors& stress) const {
  Tensors strain;
  polyfem::strains(element_, d.segment(unknowns().first, unknowns().count), strain);
  stress.middleCols(stress_points().first, stress_points().count) += material().elasticity * strain;
}

Points VertexBlock::strain_displacement(const BlockState& state) const {
  // The projection: K w = integral of B^T sigma. Rigid motions are made stiff, and so is, a little, whatever
  // else an unsound rule leaves without stiffness.
  const double scale = stiffness_.trace() / n_unknowns();
  const Eigen::Matrix<double, Eigen::Dynamic, 3> rigid = rigid_modes_.colwise().normalized();
  MatrixXd K = stiffness_ + scale * rigid * rigid.transpose();
  K.diagonal().array() += negligible_stiffness * scale;
  VectorXd f(n_unknowns());
  polyfem::stress_forces(element_, state.stress.middleCols(stress_points().first, stress_points().count), f);
  Points w = K.llt().solve(f).reshaped(2, n_vertices());

  // K was made with gradients corrected by a constant c_i each: their part is a uniform strain.
  const PointsRef outline = state.position.middleCols(vertices().first, vertices().count);
  polyfem::ShapeValues shape;
  polyfem::wachspress(outline, element_.rule.points.col(0), shape);
  const VectorXd cx = element_.dx.row(0).transpose() - shape.gradients.row(0).transpose(),
                 cy = element_.dy.row(0).transpose() - shape.gradients.row(1).transpose();
  const Vec2 u_by_x = w * cx, u_by_y = w * cy;
  const Vec3 strain(u_by_x.x(), u_by_y.y(), u_by_y.x() + u_by_x.y());
  w += uniform_strain_displacement(outline, moments().centroid, strain);
  return w;
}

Integration choose_integration(const PointsRef& outline, GradientCorrection correction) {
  static const TriangleRule fine = polyfem::collapsed_gauss_rule(12, 12, 2);
  const std::array rules{&polyfem::hammer_rule(3), &polyfem::hammer_rule(5), &fine};
  const Mat3 elasticity = polyfem::elasticity_matrix(1, 0.3, polyfem::Plane::strain);
  polyfem::TabulatedElement element;
  MatrixXd K, M;
  for (const TriangleRule* rule : rules) {
    tabulate(outline, *rule, polyfem::wachspress, correction, element);
    polyfem::stiffness(element, elasticity, K);
    polyfem::mass(element, M);
    const bool sound = polyfem::judge(K, M).sound();
    if (sound || correction == GradientCorrection::off) return {rule, correction, sound};
  }
  return {rules.back(), correction, false};
}

}  // namespace ddacontact
