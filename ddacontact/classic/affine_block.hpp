/// \file Shi's block: six unknowns, constant strain, Eq. (1)-(3).
#pragma once

#include <ddacontact/block/control_vertices.hpp>
#include <ddacontact/classic/incremental_block.hpp>

#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace ddacontact {

/// Displacements of a point by the unknowns (1), T of (3).
using Transformation = Eigen::Matrix<double, 2, PointMap::capacity>;

/// Unknowns: (u0 v0 r0 eps_x eps_y gamma_xy) about the centroid (1); or, given control vertices, their
/// displacements (u v u v u v), which span the same affine fields.
class AffineBlock final : public IncrementalBlock {
 public:
  AffineBlock(const BlockMaterial& material, const PointsRef& outline,
              const std::optional<ControlVertices>& control = std::nullopt);

  std::unique_ptr<Block> copy() const override { return std::make_unique<AffineBlock>(*this); }
  int n_unknowns() const override { return Transformation::ColsAtCompileTime; }
  int n_stress_points() const override { return 1; }
  VectorXd unknown_lengths() const override;
  PointMap vertex_map(int vertex) const override;
  void add_stress_forces(const BlockState& state, VectorXd& F) const override;
  void add_body_force(const Vec2& b, VectorXd& F) const override;
  void add_stress(const VectorXd& d, Tensors& stress) const override;
  Points strain_displacement(const BlockState& state) const override;
  Points integration_points() const override { return Points::Zero(2, 1); }

 private:
  using Mat6 = Eigen::Matrix<double, Transformation::ColsAtCompileTime, Transformation::ColsAtCompileTime>;

  void take_shape(const PointsRef& outline) override;

  std::optional<ControlVertices> control_;
  Mat6 basis_;  ///< (1) = basis_ * unknowns
  std::vector<std::array<PointMap::Term, PointMap::capacity>>
      vertex_maps_;  ///< T (3) * basis_ at each outline vertex
};

}  // namespace ddacontact
