/// \file Blocks in a frame that turns with them: displacements from the reference shape, exact rotations.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>

#include <memory>

namespace ddacontact {

/// Matrices are computed once, of the reference shape, and turned with the block. Area and stress are exact
/// at any rotation.
class CorotationalBlock final : public Block {
 public:
  CorotationalBlock(const BlockMaterial& material, const PointsRef& outline,
                    std::shared_ptr<const CorotationalShape> shape);

  int n_unknowns() const override { return 2 * static_cast<int>(shape_->nodes.cols()); }
  int n_stress_points() const override { return static_cast<int>(shape_->element.n_points()); }
  VectorXd unknown_lengths() const override { return VectorXd::Ones(n_unknowns()); }
  PointMap vertex_map(int vertex) const override;
  void add_body_force(const Vec2& b, VectorXd& F) const override;
  void begin_step(const BlockState& state, const StepStart& start) override;
  VectorXd free_path() const override;
  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const override;
  void tangent(const Eigen::Ref<const VectorXd>& d, MatrixXd& A) const override;
  void add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const override;
  void end_step(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external, bool is_free,
                BlockState& next) const override;
  double stored_energy(const Eigen::Ref<const VectorXd>& d) const override;
  double elastic_loss(const Eigen::Ref<const VectorXd>& d, const VectorXd& elastic) const override;
  Tensors stress(const BlockState& state) const override;
  Points strain_displacement(const BlockState& state) const override;

 private:
  using Frame = polyfem::CorotatedFrame;

  void prepare_shape(const PointsRef& outline) override;
  Points nodes(const PointsRef& outline) const { return outline * shape_->nodes_of_outline.transpose(); }
  /// Changes or velocities of the nodes, 2 x m, by those of the unknowns, and back.
  Points to_nodes(const Eigen::Ref<const VectorXd>& d) const;
  VectorXd to_unknowns(const Points& changes) const;
  VectorXd forces_on_unknowns(const Points& on_nodes) const;

  /// A block's motion as a rigid body: momentum over mass, angular momentum over inertia, and what is left.
  struct Motion {
    Vec2 linear;
    double angular;
    Points deformation;  ///< velocities of the nodes, 2 x m
  };
  Vec2 centre(const Points& y) const { return y * mass_of_translation_ / mass_total_; }
  /// Velocities of a unit rotation about the centre of mass.
  Points spin(const Points& y) const;
  Motion split(const Points& y, const Points& velocity) const;
  /// The same motion of the block in another place.
  Points motion_at(const Points& y, const Motion& motion) const;

  void elastic_force(const Frame& end, const VectorXd& initial_force, VectorXd& f) const;
  Points inertia_force(const Points& step, const Frame& end) const;
  /// Where the velocity at the start and a jump within the step lead, from the start.
  Points path(const Points& step) const;
  /// Velocity of deformation within the step: its mean, and that at the start carried to the middle.
  Points mean_deforming(const Points& step) const;
  Points carried_deforming(const Frame& end) const;
  MatrixXd rigid_mass() const;

  std::shared_ptr<const CorotationalShape> shape_;
  MatrixXd inverse_basis_;
  VectorXd mass_of_translation_;  ///< M t
  double mass_total_;             ///< t M t

  // Of the step last begun.
  StepRule rule_;
  double dt_ = 0;
  Points y0_, velocity_, acceleration_;
  Motion jump_, jump_path_;  ///< turn with the block: see motion_at
  Points deforming_;         ///< velocity of deformation at the start, in the block's frame
  VectorXd initial_force_;   ///< of the stress that the reference shape has
  Frame start_;
  MatrixXd reference_tangent_;
};

}  // namespace ddacontact
