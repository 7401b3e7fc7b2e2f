/// \file Blocks that meet within a step: when, and what it does to their velocities.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact_builder.hpp>

#include <vector>

namespace ddacontact {

/// An impact within a step.
struct StepImpact {
  VectorXd jump;             ///< of the velocities of all unknowns
  VectorXd jump_path;        ///< jump times what is left of the step after it
  std::vector<char> hit;     ///< the contacts that met with a speed that counts
  std::vector<char> parted;  ///< the contacts that it drives apart with a speed that counts; empty: none
  int n_hits = 0;
  double friction_loss = 0, normal_loss = 0;  ///< kinetic energy lost, J per m
  bool limited = false;                       ///< restitution was reduced so that no energy arises
  bool settled = true;
};

/// Follows the blocks on their way without forces (with gravity those that touch nothing) and lets those that
/// meet within the step collide as rigid bodies: the approach of a hitting contact becomes `restitution`
/// (of its joint) times itself away. Closed contacts take part, without restitution. A contact hits when its approach is
/// faster than what gravity makes in a tenth of the step; its restitution counts when it is faster than what
/// gravity makes in two steps: bounces that short are not resolved.
///
/// \param[in,out] blocks   prepared for `state`, before and after
/// \param[in] properties   of the contacts of these blocks
/// \param[in] also         contacts that are known to close within the step; empty: none
StepImpact foresee_impact(BlockSystem& blocks, const BlockState& state, const ContactProperties& properties,
                          const std::vector<Contact>& contacts, const VectorXd& velocity, double dt,
                          const std::vector<char>& also);

/// The least approach of a contact that counts as a hit, m/s.
double least_approach(const BlockSystem& blocks, const Contact& contact, double dt);

}  // namespace ddacontact
