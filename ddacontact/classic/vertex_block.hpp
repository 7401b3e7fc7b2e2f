/// \file The paper's block: its unknowns are the displacements of its vertices, Eq. (4)-(8).
#pragma once

#include <ddacontact/block/integration.hpp>
#include <ddacontact/classic/incremental_block.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/tabulated_element.hpp>

#include <memory>

namespace ddacontact {

/// A block interpolated by (6), or by mean value functions, on its current shape, as stiff and as heavy as
/// its integration makes it. Where Wachspress functions cease to exist, as a corner has turned concave, mean
/// value ones take their place for as long as it is.
class VertexBlock final : public IncrementalBlock {
 public:
  /// `outline`: counter-clockwise, and such that the basis can be used.
  VertexBlock(const BlockMaterial& material, const PointsRef& outline, const Integration& integration,
              const polyfem::Basis& basis = polyfem::wachspress);
  VertexBlock(const BlockMaterial& material, const PointsRef& outline)
      : VertexBlock(material, outline, choose_integration(outline, polyfem::GradientCorrection::on)) {}

  std::unique_ptr<Block> copy() const override { return std::make_unique<VertexBlock>(*this); }
  int n_unknowns() const override { return 2 * n_vertices(); }
  int n_stress_points() const override;
  VectorXd unknown_lengths() const override { return VectorXd::Ones(n_unknowns()); }
  PointMap vertex_map(int vertex) const override;
  void add_stress_forces(const BlockState& state, VectorXd& F) const override;
  void add_body_force(const Vec2& b, VectorXd& F) const override;
  void add_stress(const VectorXd& d, Tensors& stress) const override;
  Points strain_displacement(const BlockState& state) const override;
  BlockCell cell(int c) const override;
  Points integration_points() const override { return element_.rule.points.colwise() - moments_.centroid; }

 private:
  void take_shape(const PointsRef& outline) override;

  const polyfem::Basis& usable_basis(const PointsRef& outline) const;

  Integration integration_;
  const polyfem::Basis* basis_;
  polyfem::Triangles ears_;  ///< triangles that carry the integration points; none: the centroid fan does
  polyfem::TabulatedElement element_;
  VectorXd shape_integrals_;
};

}  // namespace ddacontact
