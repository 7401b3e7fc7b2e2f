/// \file How far the blocks are from equilibrium and rest at the end of a substep.
#pragma once

#include <ddacontact/core/rest_criterion.hpp>
#include <ddacontact/time/trial_step.hpp>

#include <vector>

namespace ddacontact {

/// A block is in balance when the resultant of weight, loads, contact forces and reactions is at most this
/// times the largest of these forces. Contacts are solved to 1e-8 of the forces; a structure 3 % beyond its
/// limit load leaves 5e-4 or more of them.
inline constexpr double largest_unbalanced = 1e-4;

/// Balance of forces and velocities at the end of a substep. The resultant on a block is its mass times its
/// acceleration: a static step, which starts at rest, leaves the same resultant on a block that falls
/// whatever its length is, and none on one that has settled. Blocks that sleep are at rest.
struct Equilibrium {
  /// Largest over the blocks of |weight + loads + contact forces + reactions|, or of their moment about the
  /// centroid over the block's size where that is larger, over the largest of these forces on the same block.
  double unbalanced = 0;
  int unbalanced_block = -1;     ///< the block of that value; -1: no block is out of balance
  int n_unbalanced = 0;          ///< blocks out of balance
  double unbalanced_before = 0;  ///< `unbalanced` at the end of the substep before
  double fastest = 0;         ///< m/s, of any vertex; in static steps displacement over length of the substep
  int fastest_block = -1;     ///< the block of that vertex; -1: nothing moves
  double relative_speed = 0;  ///< of any vertex, sizes of its block a second
  double kinetic = 0;         ///< of these velocities, J per m

  bool in_balance() const { return unbalanced <= largest_unbalanced; }
  /// \param[in] exchanged  the largest energy exchanged so far, J per m
  bool meets(const RestCriterion& criterion, double exchanged) const {
    return in_balance() && (!criterion.kinetic || kinetic <= *criterion.kinetic * exchanged) &&
           (!criterion.displacement || relative_speed <= *criterion.displacement);
  }
};

/// \param[in] system     of the substep
/// \param[in] solution   its forces, reactions and straight motion
/// \param[in] before     the state that it began in
/// \param[in] reactions  of supports, N per m, 2 x all points
/// \param[in] velocity   at the end of the substep; in a static one its displacements over its length
Equilibrium find_equilibrium(const StepSystem& system, const TrialSolution& solution,
                             const std::vector<Contact>& contacts, const BlockState& before,
                             const Points& reactions, const VectorXd& velocity);

}  // namespace ddacontact
