/// \file Blocks in a frame that turns with them: displacements from the reference shape, exact rotations.
#pragma once

#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/block/corotational_step.hpp>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace ddacontact {

/// One cell or many that turn each with a frame of its own. Matrices are computed once, of the reference
/// shape, and turned with the block. Area and stress are exact at any rotation.
class CorotationalBlock final : public Block {
 public:
  CorotationalBlock(const BlockMaterial& material, const PointsRef& points,
                    std::shared_ptr<const CorotationalShape> shape);

  const CorotationalShape* shape() const override { return shape_.get(); }
  int n_coordinates() const override {
    return BlockState::n_rigid + 2 * static_cast<int>(shape_->nodes.cols());
  }
  int n_unknowns() const override { return static_cast<int>(shape_->n_unknowns()); }
  int n_stress_points() const override { return static_cast<int>(shape_->integration_weights.size()); }
  bool changes_stress() const override { return false; }
  VectorXd unknown_lengths() const override { return VectorXd::Ones(n_unknowns()); }
  VectorXd initial_force(const BlockState& state) const override;
  PointMap vertex_map(int point) const override;
  const Eigen::Matrix<double, Eigen::Dynamic, 2>& translations() const override {
    return shape_->translations;
  }
  MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const override;
  void add_body_force(const Vec2& b, VectorXd& F) const override;
  void begin_step(const BlockState& state, const StepStart& start) override;
  void free_path(Eigen::Ref<VectorXd> path) const override;
  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const override;
  int n_parts() const override { return n_cells(); }
  std::vector<int> part_unknowns(int part) const override { return shape_->cells[part].unknowns; }
  using Block::tangent;
  void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const override;
  void add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const override;
  void end_step(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external, bool is_free,
                BlockState& next) const override;
  void displacement(const Eigen::Ref<const VectorXd>& d, Eigen::Ref<VectorXd> displaced) const override;
  std::optional<BlockMotion> motion() const override;
  double stored_energy(const Eigen::Ref<const VectorXd>& d) const override;
  double elastic_loss(const Eigen::Ref<const VectorXd>& d,
                      const Eigen::Ref<const VectorXd>& elastic) const override;
  double kinetic_energy(const Eigen::Ref<const VectorXd>& velocity) const override;
  Tensors stress(const BlockState& state) const override;
  double elastic_energy(const BlockState& state) const override;
  Points strain_displacement(const BlockState& state) const override;
  Points integration_points() const override;
  const VectorXd& integration_weights() const override { return shape_->integration_weights; }
  int n_cells() const override { return static_cast<int>(shape_->cells.size()); }
  BlockCell cell(int c) const override;
  CellStress cell_stress(const BlockState& state, int c) const override;

 private:
  using Frame = polyfem::CorotatedFrame;

  void prepare_shape(const PointsRef& points) override;
  void map_points();
  double elastic_energy_of_deformation(const BlockState& state) const;
  Points nodes(const BlockState& state) const;
  Frame cell_frame(const BlockState& state, const Points& y, int c) const;
  /// Stress of the reference shape, in the block's frame; empty: none.
  TensorsRef initial_stress(const BlockState& state) const;
  TensorsRef initial_stress(const BlockState& state, int c) const;
  /// The stress in the cell's own frame.
  Tensors cell_stresses(const BlockState& state, const Frame& frame, int c) const;
  /// work(nodes, the step last begun)
  template <class Work>
  auto with_step(const Work& work) const;

  std::shared_ptr<const CorotationalShape> shape_;
  std::vector<std::vector<PointMap::Term>> point_maps_;  ///< empty: each point has two unknowns of its own
  CorotationalStart start_;                              ///< of the step last begun
};

}  // namespace ddacontact
