#include <ddacontact/classic/vertex_block.hpp>

#include <ddacontact/block/stress_projection.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>

namespace ddacontact {

VertexBlock::VertexBlock(const BlockMaterial& material, const PointsRef& outline,
                         const Integration& integration, const polyfem::Basis& basis)
    : IncrementalBlock(material, outline), integration_(integration), basis_(&basis) {
  if (!polyfem::is_star_shaped(outline, polyfem::area_moments(outline).centroid))
    ears_ = polyfem::triangulate(outline);
  VertexBlock::take_shape(outline);
}

const polyfem::Basis& VertexBlock::usable_basis(const PointsRef& outline) const {
  if (basis_ != &polyfem::wachspress || !polyfem::find_non_convex_corner(outline)) return *basis_;
  return polyfem::mean_value;
}

BlockCell VertexBlock::cell(int c) const {
  BlockCell whole = Block::cell(c);
  whole.basis = basis_;
  return whole;
}

int VertexBlock::n_stress_points() const {
  return (ears_.cols() > 0 ? static_cast<int>(ears_.cols()) : n_vertices()) *
         static_cast<int>(integration_.triangle_rule->weights.size());
}

void VertexBlock::take_shape(const PointsRef& outline) {
  moments_ = polyfem::area_moments(outline);
  polyfem::PolygonRule rule;
  if (ears_.cols() == 0)
    polyfem::make_fan_rule(outline, *integration_.triangle_rule, rule);
  else
    polyfem::make_ear_rule(outline, ears_, *integration_.triangle_rule, rule);
  tabulate(outline, rule, usable_basis(outline), integration_.correction, element_);
  polyfem::stiffness(element_, material().elasticity, stiffness_);
  polyfem::mass(element_, mass_);
  mass_ *= density();
  polyfem::shape_integrals(element_, shape_integrals_);
  integration_weights_ = element_.rule.weights;

  translations_.resize(n_unknowns(), 2);
  rotation_.resize(n_unknowns());
  for (int i = 0; i < n_vertices(); ++i) {
    const Vec2 r = outline.col(i) - moments_.centroid;
    translations_.middleRows<2>(2 * i).setIdentity();
    rotation_.segment<2>(2 * i) << -r.y(), r.x();
  }
}

PointMap VertexBlock::vertex_map(int vertex) const {
  return PointMap(unknowns().first + 2 * vertex);
}

void VertexBlock::add_stress_forces(const BlockState& state, VectorXd& F) const {
  VectorXd f(n_unknowns());
  polyfem::stress_forces(element_, stress_points().columns_of(state.stress), f);
  unknowns().of(F) -= f;
}

void VertexBlock::add_body_force(const Vec2& b, VectorXd& F) const {
  const Vec2 current = b * (reference_area() / moments_.area);
  for (int i = 0; i < n_vertices(); ++i)
    F.segment<2>(unknowns().first + 2 * i) += shape_integrals_[i] * current;
}

void VertexBlock::add_stress(const VectorXd& d, Tensors& stress) const {
  Tensors strain;
  polyfem::strains(element_, unknowns().of(d), strain);
  stress_points().columns_of(stress) += material().elasticity * strain;
}

Points VertexBlock::strain_displacement(const BlockState& state) const {
  return stress_projection(element_, stiffness_, outline(state), stress_points().columns_of(state.stress),
                           usable_basis(outline(state)));
}

}  // namespace ddacontact
