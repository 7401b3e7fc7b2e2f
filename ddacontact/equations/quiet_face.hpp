/// \file A viscous boundary through one step.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <vector>

namespace ddacontact {

/// The dashpots of a quiet face (Lysmer & Kuhlemeyer 1969) on the unknowns of its block: forces -C v of the
/// mean velocity of the step, or with half steps of the means of the half steps before and after the forces.
class StepQuietFace {
 public:
  StepQuietFace(const BlockSystem& blocks, const QuietFace& face);

  /// Unknowns that its matrix is over, ascending.
  const std::vector<int>& unknowns() const { return unknowns_; }
  int block() const { return face_->block; }

  void begin(const BlockSystem& blocks, const BlockState& state, const StepStart& start);
  /// F += its forces for the displacements of the step, of all unknowns.
  void add_forces(const VectorXd& d, VectorXd& F) const;
  /// Minus the derivative of its forces over `unknowns`.
  MatrixXd tangent() const { return by_displacement_ * damping_; }

 private:
  const QuietFace* face_;
  std::vector<int> unknowns_;
  Eigen::Matrix<double, 2, Eigen::Dynamic> ends_[2];  ///< displacement of both ends by `unknowns`
  MatrixXd damping_;                                  ///< C over `unknowns`, N s/m per m
  double by_displacement_ = 0;                        ///< of the velocity, 1/s
  VectorXd before_;  ///< the part of the velocity that is known, of `unknowns`
};

}  // namespace ddacontact
