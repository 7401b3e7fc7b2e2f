/// \file Blocks in a frame that turns with them: displacements from the reference shape, exact rotations.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>

#include <memory>

namespace ddacontact {

/// One cell or many that turn each with a frame of its own. Matrices are computed once, of the reference
/// shape, and turned with the block. Area and stress are exact at any rotation.
class CorotationalBlock final : public Block {
 public:
  CorotationalBlock(const BlockMaterial& material, const PointsRef& places,
                    std::shared_ptr<const CorotationalShape> shape);

  int n_unknowns() const override { return static_cast<int>(shape_->n_unknowns()); }
  int n_stress_points() const override { return first_point_.back(); }
  VectorXd unknown_lengths() const override { return VectorXd::Ones(n_unknowns()); }
  PointMap vertex_map(int place) const override;
  MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const override;
  void add_body_force(const Vec2& b, VectorXd& F) const override;
  void begin_step(const BlockState& state, const StepStart& start) override;
  VectorXd free_path() const override;
  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const override;
  int n_parts() const override { return n_cells(); }
  std::vector<int> part_unknowns(int part) const override { return shape_->cells[part].unknowns; }
  using Block::tangent;
  /// Of blocks of several cells under the decaying scheme the deformation is given twice its inertia, as all
  /// other motion has it: what is exact couples all nodes.
  void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const override;
  void add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const override;
  void end_step(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external, bool is_free,
                BlockState& next) const override;
  double stored_energy(const Eigen::Ref<const VectorXd>& d) const override;
  double elastic_loss(const Eigen::Ref<const VectorXd>& d, const VectorXd& elastic) const override;
  Tensors stress(const BlockState& state) const override;
  double elastic_energy(const BlockState& state) const override;
  Points strain_displacement(const BlockState& state) const override;
  Points integration_points() const override;
  int n_cells() const override { return static_cast<int>(shape_->cells.size()); }
  BlockCell cell(int c) const override;
  CellStress cell_stress(const BlockState& state, int c) const override;

 private:
  using Frame = polyfem::CorotatedFrame;
  /// Of every cell, and the rotation of the block's mean deformation gradient.
  struct Frames {
    std::vector<Frame> cells;
    Mat2 rotation;
  };

  /// Whether the only cell has all nodes in their order.
  bool is_one_cell() const { return shape_->cells[0].nodes.empty(); }
  void prepare_shape(const PointsRef& places) override;
  void map_places();
  Points nodes(const PointsRef& places) const;
  Points nodes(const BlockState& state) const;
  Frames frames(const Points& y) const;
  Frame cell_frame(const Points& y, int c) const;
  Tensors initial_stress(const BlockState& state, int c) const;
  /// The stress in the cell's own frame.
  Tensors cell_stresses(const BlockState& state, const Frame& frame, int c) const;
  /// Adds what acts on the nodes of a cell.
  void add_of_cell(const VectorXd& f, int c, Points& on_nodes) const;
  /// v M
  Points weighted(const Points& v) const;
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

  void elastic_force(const Frame& start, const Frame& end, int c, const VectorXd& initial_force,
                     VectorXd& f) const;
  Points inertia_force(const Points& step, const Frames& end) const;
  /// Where the velocity at the start and a jump within the step lead, from the start.
  Points path(const Points& step) const;
  /// Velocity of deformation within the step: its mean, and that at the start carried to the middle.
  Points mean_deforming(const Points& step) const;
  Points carried_deforming(const Frames& end) const;
  MatrixXd rigid_mass() const;

  std::shared_ptr<const CorotationalShape> shape_;
  std::vector<std::vector<PointMap::Term>> place_maps_;  ///< empty: each place has two unknowns of its own
  std::vector<int> first_point_;  ///< of each cell among the stress points, and their number
  VectorXd mass_of_translation_;  ///< M t
  double mass_total_;             ///< t M t

  // Of the step last begun.
  StepRule rule_;
  double dt_ = 0;
  Points y0_, velocity_, acceleration_;
  Motion jump_, jump_path_;              ///< turn with the block: see motion_at
  Points deforming_;                     ///< velocity of deformation at the start, in the block's frame
  std::vector<VectorXd> initial_force_;  ///< of the stress that the reference shape has, by cell
  Frames start_;
  std::vector<MatrixXd> reference_tangent_;  ///< by cell
};

}  // namespace ddacontact
