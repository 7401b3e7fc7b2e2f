/// \file Blocks in a frame that turns with them: displacements from the reference shape, exact rotations.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>

#include <memory>
#include <vector>

namespace ddacontact {

/// One cell or many that turn each with a frame of its own. Matrices are computed once, of the reference
/// shape, and turned with the block. Area and stress are exact at any rotation.
class CorotationalBlock final : public Block {
 public:
  CorotationalBlock(const BlockMaterial& material, const PointsRef& points,
                    std::shared_ptr<const CorotationalShape> shape)
      : Block(material, points, shape->n_outline), shape_(std::move(shape)) {}

  std::unique_ptr<Block> copy() const override { return std::make_unique<CorotationalBlock>(*this); }
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
  using Block::rotation;
  void rotation(const BlockState& state, Eigen::Ref<VectorXd> unknowns) const override;
  MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const override;
  void add_body_force(const Vec2& b, VectorXd& F) const override;
  void begin_step(const BlockState& state, const StepStart& start,
                  std::unique_ptr<BlockStep>& step) const override;
  int n_parts() const override { return n_cells(); }
  std::vector<int> part_unknowns(int part) const override { return shape_->cells[part].unknowns; }
  double kinetic_energy(const VectorIn& velocity) const override;
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

  /// A step of this kind in `step`.
  template <class Step>
  Step& renew(std::unique_ptr<BlockStep>& step) const;
  double elastic_energy_of_deformation(const BlockState& state) const;
  Points nodes(const BlockState& state) const;
  Frame cell_frame(const BlockState& state, const Points& y, int c) const;
  /// Stress of the reference shape, in the block's frame; empty: none.
  TensorsRef initial_stress(const BlockState& state) const;
  TensorsRef initial_stress(const BlockState& state, int c) const;
  /// The stress in the cell's own frame.
  Tensors cell_stresses(const BlockState& state, const Frame& frame, int c) const;

  std::shared_ptr<const CorotationalShape> shape_;
};

}  // namespace ddacontact
