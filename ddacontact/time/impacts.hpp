/// \file Impacts within a step: their times, and the jumps of velocities.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact_builder.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace ddacontact {

/// The impacts within a step.
struct StepImpact {
  VectorXd jump;   ///< of the velocities of all unknowns; empty: none
  VectorXd shift;  ///< minus the sum of the jumps times their times within the step
  /// Start, shifted and with velocities that have jumped, from which the step ends as if the blocks had moved
  /// with their velocities after the impact all the time.
  BlockState start;
  /// Numbers of the free blocks that jump, and the accelerations of their unknowns until then by the forces
  /// of the step before and the loads.
  std::vector<std::pair<int, VectorXd>> acceleration_before;
  std::vector<char> hit;  ///< the contacts that met with a speed that counts
  int n_hits = 0;
  double friction_loss = 0, normal_loss = 0;  ///< kinetic energy lost, J per m
  double support_work = 0;                    ///< done by supports that move, J per m
  bool limited = false;                       ///< restitution was reduced so that no energy arises
  bool settled = true;

  bool changes() const { return jump.size() > 0; }
};

/// The restitution of a contact, nothing where blocks part as their elasticity has it. Schemes other than the
/// decaying and the explicit one reverse the approach of contacts that close: they have impacts everywhere.
std::optional<double> restitution_of(const ContactProperties& properties, const VertexEdge& pair,
                                     const StepRule& rule);

/// A step in which blocks may meet.
struct ImpactStep {
  const BlockSystem& blocks;
  const BlockState& state;
  const ContactProperties& properties;  ///< of the contacts of these blocks
  const std::vector<Contact>& contacts;
  StepRule rule;
  double dt;  ///< s
};

/// Follows the blocks on their way without forces (with gravity and loads those that touch nothing) and lets
/// those that meet within the step collide as rigid bodies, one impact after another; meetings within the
/// time that a pressure wave takes through a block are one impact, by Poisson's law: impulses stop the
/// approach of all its contacts, then a hitting contact gets `restitution` times its own once more, so that
/// one alone separates with `restitution` times its approach. Of a row of blocks that touch without force
/// each passes on to the next what it got. Contacts that bear, or have met in the step and touch since, take
/// part, without restitution. A contact hits when its approach is faster than what gravity makes in a tenth
/// of the step; its restitution counts when it is faster than what gravity makes in two steps: bounces that
/// short are not resolved. After as many impacts as there are contacts the step's own contact forces take
/// what still approaches.
///
/// \param[in] forced  contacts that are known to close within the step; empty: none
StepImpact predict_impact(const ImpactStep& step, const std::vector<char>& forced);

/// The least approach of a contact that counts as a hit, m/s.
double least_approach(const BlockSystem& blocks, const Contact& contact, double dt);

}  // namespace ddacontact
