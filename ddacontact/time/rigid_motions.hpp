/// \file Rigid motions of some blocks that their supports allow.
#pragma once

#include <ddacontact/block/block_system.hpp>

#include <span>

namespace ddacontact {

/// The velocities of blocks as rigid bodies, by coefficients q whose kinetic energy is q.q / 2: up to three
/// for each block, none for what a block's held unknowns prevent. On the shapes last prepared.
class RigidMotions {
 public:
  RigidMotions(const BlockSystem& blocks, std::span<const int> of_blocks);

  int n_coefficients() const { return static_cast<int>(block_of_.size()); }
  /// The block that a coefficient moves.
  int block_of(int coefficient) const { return block_of_[coefficient]; }
  /// The rigid part of velocities of all unknowns: what is left over is orthogonal to it in kinetic energy.
  VectorXd coefficients(const VectorXd& velocity) const;
  /// velocity += the motion q, on all unknowns; 0 on held ones.
  void add_motion(const VectorXd& q, VectorXd& velocity) const;
  /// A form of the coefficients whose value is the rate of change of `form`, one of all unknowns; 0 + ... .
  /// Over the same coefficients for every form over the same unknowns.
  AffineForm rate_form(const AffineForm& form) const;

 private:
  struct Part {
    const Block* block;
    int first;  ///< of its coefficients
    MatrixXd modes;
  };

  std::vector<Part> parts_;
  std::vector<int> part_of_unknown_;  ///< index in parts_, -1: none
  std::vector<int> block_of_;
};

}  // namespace ddacontact
