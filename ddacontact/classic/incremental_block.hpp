/// \file Blocks whose displacements add up step by step on the current shape, as the paper has it.
#pragma once

#include <ddacontact/block/block.hpp>

#include <span>

namespace ddacontact {

/// All matrices are of the shape last prepared, and stresses sum up (12) without being turned.
class IncrementalBlock : public Block {
 public:
  /// Throws Error for the schemes with half steps and for the midpoint scheme.
  void begin_step(const BlockState& state, const StepStart& start) override;
  void free_path(Eigen::Ref<VectorXd> path) const override { path = path_; }
  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const override;
  void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const override;
  const Eigen::Matrix<double, Eigen::Dynamic, 2>& translations() const override { return translations_; }
  MatrixXd times_mass(const Eigen::Ref<const MatrixXd>& velocities) const override {
    return mass_ * velocities;
  }
  void end_step(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external, bool is_free,
                BlockState& next) const override;
  double stored_energy(const Eigen::Ref<const VectorXd>& d) const override;
  Tensors stress(const BlockState& state) const override { return stress_points().columns_of(state.stress); }

  const VectorXd& integration_weights() const override { return integration_weights_; }

  /// K of (17), n_unknowns x n_unknowns.
  const MatrixXd& stiffness() const { return stiffness_; }
  /// F -= integral of B^T sigma, Eq. (19), of all unknowns.
  virtual void add_stress_forces(const BlockState& state, VectorXd& F) const = 0;
  /// Adds the stress that displacements d of all unknowns make, Eq. (8), (9), (12).
  virtual void add_stress(const VectorXd& d, Tensors& stress) const = 0;

 protected:
  IncrementalBlock(const BlockMaterial& material, const PointsRef& outline)
      : Block(material, outline, static_cast<int>(outline.cols())) {}
  /// The density scaled by reference over current area, so that a block that inflates makes no mass.
  double current_density() const { return material().density * reference_area() / moments().area; }

  Eigen::Matrix<double, Eigen::Dynamic, 2> translations_;
  MatrixXd stiffness_, mass_;
  VectorXd integration_weights_;

 private:
  StepRule rule_;
  double dt_ = 0;
  VectorXd velocity_, acceleration_, path_;  ///< path_: displacements without forces
  VectorXd stress_forces_;                   ///< integral of B^T sigma at the start of the step
};

}  // namespace ddacontact
