/// \file What a step by the blocks' motions leaves: energies, reactions, and how far each block is from
/// balance.
#pragma once

#include <ddacontact/contact/contact.hpp>
#include <ddacontact/solver/step_system.hpp>

#include <vector>

namespace ddacontact {

/// What a step does to the energies, J per m, each from its own definition.
struct StepWork {
  double gravity = 0;     ///< change of the potential
  double external = 0;    ///< work of loads and supports
  double friction = 0;    ///< taken by friction
  double damping = 0;     ///< taken by damping, and by contacts that end an approach
  double pushed_out = 0;  ///< put in by contacts that push penetration out
  double scheme = 0;      ///< taken by the scheme; the change of kinetic energy is still to be taken off
};

/// The forces on a block, for the verdict on its balance, N per m.
struct BlockForceSum {
  double resultant = 0;  ///< |force| or |moment| / size, the larger: mass times acceleration
  double largest = 0;    ///< of weight, loads and reactions; contact forces are the contacts'
};

/// An accepted step as its blocks still have it begun.
struct MotionStep {
  const BlockState& from;          ///< where it starts: shifted and jumped by an impact
  const VectorXd& straight;        ///< the straight motion of all unknowns
  const VectorXd& prescribed;      ///< displacements of the prescribed degrees of freedom
  const Residual& residual;        ///< reactions of prescribed degrees of freedom
  std::vector<Contact>& contacts;  ///< gap and slip changes are set to those of the straight motion
};

/// An impulse works on the straight motion of the shape at the start. What turns away from that on the way,
/// of slips and of prescribed points, is the scheme's.
StepWork account_motion_step(const BlockSystem& blocks, const StepSystem& system, const MotionStep& step);

/// Mass times acceleration of every block, and the largest force beside those of contacts.
std::vector<BlockForceSum> sum_forces(const BlockSystem& blocks, const StepSystem& system,
                                      const VectorXd& straight, const Points& reactions);

}  // namespace ddacontact
