/// \file Rigid motions of some blocks that their supports allow.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <span>
#include <vector>

namespace ddacontact {

/// The velocities of blocks as rigid bodies, by coefficients q whose kinetic energy is q.q / 2: up to three
/// for each block, none for what a block's prescribed degrees of freedom prevent.
class RigidMotions {
 public:
  RigidMotions(const BlockSystem& blocks, const BlockState& state, std::span<const int> of_blocks);

  int n_coefficients() const { return n_coefficients_; }
  /// Largest mass of the blocks that move, kg per m; 0: none does.
  double largest_mass() const;
  /// Coefficients of the rigid part of velocities of all unknowns: the rest is orthogonal to it in kinetic
  /// energy.
  VectorXd coefficients(const VectorXd& velocity) const;
  /// velocity += the motion q, on all unknowns; 0 on held ones.
  void add_motion(const VectorXd& q, VectorXd& velocity) const;
  /// The rate of change of `form`, one of all unknowns, as a form of the coefficients: over the same of them
  /// for every form over the same unknowns. Those that do not move it are 0, not round-off.
  AffineForm rate_form(const AffineForm& form) const;

 private:
  struct Part {
    const Block* block;
    int first;  ///< of its coefficients
    MatrixXd modes;
  };

  std::vector<Part> parts_;
  std::vector<int> part_of_unknown_;  ///< index in parts_, -1: none
  int n_coefficients_ = 0;
};

/// The velocities of a block's unknowns in the rigid motion that its prescribed degrees of freedom have, as
/// nearly as one can; 0 where there are none.
/// \param[in] velocity  of all unknowns
VectorXd driven_motion(const BlockSystem& blocks, const BlockState& state, const Block& block,
                       const VectorXd& velocity);

}  // namespace ddacontact
