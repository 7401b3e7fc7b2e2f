#include <ddacontact/time/motion_accounts.hpp>

#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/time/joint_springs.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// What a contact takes or gives: friction, the end of an approach, and pushing out.
void account_contact(const StepRule& rule, double dt, const BlockState& from, const VectorXd& straight,
                     Contact& contact, Energy& energy) {
  if (contact.normal == 0 && contact.shear == 0 && !contact.law.compliant) return;
  const GapAndSlip start = contact.motion.rates_at(contact.motion.positions(), contact.history.lock);
  const double slipped = contact.end_slip - start.slip;
  contact.gap_change = contact.motion.change_along(start.by_gap, straight);
  contact.slip_change = contact.motion.change_along(start.by_slip, straight);
  if (contact.law.compliant) {
    account_joint_springs(contact, false, energy);
    return;
  }
  // An impulse, that of a dashpot included, changes kinetic energy by p times the mean of the rates before
  // and after.
  const auto exchanged_by = [&](double force, const VertexEdgeGradient& by, double change) {
    const double before = rule.starts_at_rest ? 0 : contact.motion.change_along(by, from.going_on());
    return force * rule.impulse_time * (dt * before + change) / 2;
  };
  const double exchanged = exchanged_by(contact.normal, start.by_gap, contact.gap_change);
  double by_friction = is_slipping(contact.history.state) ? -contact.shear * slipped : 0;
  // Where blocks meet friction acts in the same impulse: what it gives back there the normal force has taken.
  double given_back = 0;
  if (contact.start_state == ContactState::open && exchanged < 0) {
    const double by_shear = exchanged_by(contact.shear, start.by_slip, contact.slip_change);
    given_back = std::clamp(by_shear + by_friction, 0.0, -exchanged);
    by_friction = std::max(by_friction, -by_shear);
  }
  energy.friction_dissipated += by_friction;
  (exchanged > 0 ? energy.pushed_out : energy.damping_dissipated) += std::abs(exchanged) - given_back;
  energy.numerical_dissipated -= contact.shear * contact.slip_change + by_friction - given_back +
                                 contact.normal * contact.gap_change - exchanged;
}

}  // namespace

void account_motion_step(const StepSystem& system, const BlockState& from, const VectorXd& straight,
                         const Residual& residual, std::vector<Contact>& contacts, Energy& energy) {
  const BlockSystem& blocks = system.blocks();
  // Loads work with their means over the step, not with those that it was computed with.
  VectorXd loads = VectorXd::Zero(straight.size());
  blocks.add_loads(from, {from.time, from.time + system.dt()}, loads);
  const double by_change = (loads - system.load_forces()).dot(straight);
  energy.external += by_change;
  energy.numerical_dissipated += by_change;
  for (const PrescribedDof& held : blocks.prescribed_dofs()) {
    const double reaction = residual.force[held.unknown], moved = system.prescribed()[held.unknown];
    energy.external += reaction * moved;
    energy.numerical_dissipated -= reaction * (straight[held.unknown] - moved);
  }
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Range& u = blocks.block(b).unknowns();
    const BlockMotion::Losses losses = blocks.block(b).motion()->losses(u.of(straight));
    energy.damping_dissipated += losses.damping;
    energy.numerical_dissipated += losses.scheme;
  }
  for (Contact& contact : contacts)
    account_contact(system.rule(), system.dt(), from, straight, contact, energy);
}

}  // namespace ddacontact
