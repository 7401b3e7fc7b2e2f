#include <ddacontact/time/motion_accounts.hpp>

#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/core/disjoint_sets.hpp>
#include <ddacontact/time/joint_springs.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// What contacts take or give: friction, the end of an approach, and pushing out.
void account_contacts(const StepSystem& system, const BlockState& from, const VectorXd& straight,
                      std::vector<Contact>& contacts, Energy& energy) {
  const auto before = [&](const Contact& contact, const VertexEdgeGradient& by) {
    return system.rule().starts_at_rest ? 0 : system.dt() * contact.motion.change_along(by, from.going_on());
  };
  // Where an approach ends all impulses on blocks that touch go together: one may give what another one has
  // taken.
  const BlockSystem& blocks = system.blocks();
  std::vector<char> hit(blocks.n_blocks(), 0);
  DisjointSets islands(blocks.n_blocks());
  for (const Contact& contact : contacts) {
    const auto [a, b] = contact.pair.blocks();
    if (contact.normal > 0 && before(contact, contact.first_gap().gradient) < -contact.end_tolerance())
      hit[a] = hit[b] = 1;
    if (contact.normal > 0 && blocks.is_movable(a) && blocks.is_movable(b)) islands.join(a, b);
  }
  std::vector<Vec2> losses(blocks.n_blocks(), Vec2::Zero());  // of islands with hit blocks
  for (Contact& contact : contacts) {
    if (contact.normal == 0 && contact.shear == 0 && !contact.law.compliant) continue;
    const GapAndSlip start = contact.motion.rates_at_start(contact.history.lock);
    contact.gap_change = contact.motion.change_along(start.by_gap, straight);
    contact.slip_change = contact.motion.change_along(start.by_slip, straight);
    if (contact.law.compliant) {
      account_joint_springs(contact, false, energy);
      continue;
    }
    // An impulse, that of a dashpot included, changes kinetic energy by p times the mean of the rates before
    // and after.
    const double half = system.rule().impulse_time / 2,
                 exchanged = half * contact.normal * (before(contact, start.by_gap) + contact.gap_change);
    energy.numerical_dissipated -= contact.normal * contact.gap_change + contact.shear * contact.slip_change;
    const auto [a, b] = contact.pair.blocks();
    if (const int moved = blocks.is_movable(a) ? a : b; hit[moved] || (hit[b] && blocks.is_movable(b))) {
      const double by_slip = half * contact.shear * (before(contact, start.by_slip) + contact.slip_change);
      losses[islands.root(moved)] -= Vec2(exchanged, by_slip);
      continue;
    }
    const double slid =
        is_slipping(contact.history.state) ? contact.shear * (start.slip - contact.end_slip) : 0;
    energy.friction_dissipated += slid;
    (exchanged > 0 ? energy.pushed_out : energy.damping_dissipated) += std::abs(exchanged);
    energy.numerical_dissipated -= slid - exchanged;
  }
  for (const Vec2& of_island : losses) account_losses(of_island[0], of_island[1], energy);
}

}  // namespace

void account_losses(double by_normal, double by_friction, Energy& energy) {
  const double all = by_normal + by_friction, of_friction = std::clamp(by_friction, 0.0, std::max(0.0, all));
  energy.numerical_dissipated -= all;
  energy.friction_dissipated += of_friction;
  (all < 0 ? energy.pushed_out : energy.damping_dissipated) += std::abs(all) - of_friction;
}

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
    const BlockMotion::Losses losses = system.step(b).motion()->losses(u.of(straight));
    energy.damping_dissipated += losses.damping;
    energy.numerical_dissipated += losses.scheme;
  }
  account_contacts(system, from, straight, contacts, energy);
}

}  // namespace ddacontact
