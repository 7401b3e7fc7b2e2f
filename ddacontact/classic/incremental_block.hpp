/// \file Blocks whose displacements add up step by step on the current shape, as the paper has it.
#pragma once

#include <ddacontact/block/block.hpp>

#include <memory>

namespace ddacontact {

/// All matrices are of the shape that the block was made of, and stresses sum up (12) without being turned.
class IncrementalBlock : public Block {
 public:
  bool follows_shape() const override { return true; }
  std::unique_ptr<Block> reshaped(const BlockState& state) const override;
  /// Throws Error for the schemes with half steps and for the midpoint scheme.
  void begin_step(const BlockState& state, const StepStart& start,
                  std::unique_ptr<BlockStep>& step) const override;
  const Eigen::Matrix<double, Eigen::Dynamic, 2>& translations() const override { return translations_; }
  using Block::rotation;
  /// On the shape that the block was made of.
  void rotation(const BlockState& /*state*/, Eigen::Ref<VectorXd> unknowns) const override {
    unknowns = rotation_;
  }
  MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const override {
    return mass_ * velocities;
  }
  Tensors stress(const BlockState& state) const override { return stress_points().columns_of(state.stress); }

  const VectorXd& integration_weights() const override { return integration_weights_; }

  /// K of (17) and M, n_unknowns x n_unknowns.
  const MatrixXd& stiffness() const { return stiffness_; }
  const MatrixXd& mass_matrix() const { return mass_; }
  /// F -= integral of B^T sigma, Eq. (19), of all unknowns.
  virtual void add_stress_forces(const BlockState& state, VectorXd& F) const = 0;
  /// Adds the stress that displacements d of all unknowns make, Eq. (8), (9), (12).
  virtual void add_stress(const VectorXd& d, Tensors& stress) const = 0;

 protected:
  /// The most derived class takes the outline as its first shape.
  IncrementalBlock(const BlockMaterial& material, const PointsRef& outline)
      : Block(material, outline, static_cast<int>(outline.cols())) {}

  /// Finds maps and matrices of this shape.
  virtual void take_shape(const PointsRef& outline) = 0;
  /// The density scaled by reference over current area, so that a block that inflates makes no mass.
  double density() const { return material().density * reference_area() / moments_.area; }

  polyfem::AreaMoments moments_;  ///< of the shape

  Eigen::Matrix<double, Eigen::Dynamic, 2> translations_;
  VectorXd rotation_;
  MatrixXd stiffness_, mass_;
  VectorXd integration_weights_;
};

}  // namespace ddacontact
