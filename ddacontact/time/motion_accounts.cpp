#include <ddacontact/time/motion_accounts.hpp>

#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/time/joint_springs.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// What a contact takes or gives: friction, the end of an approach, and pushing out.
void account_contact(const StepRule& rule, double dt, const BlockState& from, const VectorXd& straight,
                     Contact& contact, StepWork& work) {
  const bool had_force = contact.history.normal != 0 && contact.law.compliant;
  if (contact.normal == 0 && contact.shear == 0 && !had_force) return;
  const GapAndSlip start = contact.motion.rates_at(contact.motion.positions(), contact.history.lock);
  const double slipped = contact.end_slip - start.slip;
  contact.gap_change = contact.motion.change_along(start.by_gap, straight);
  contact.slip_change = contact.motion.change_along(start.by_slip, straight);
  if (contact.law.compliant) {
    const JointSpringWork of_joint = account_joint_springs(contact, false);
    work.friction += of_joint.friction;
    work.damping += of_joint.damping;
    work.scheme += of_joint.scheme;
    return;
  }
  const double by_friction = is_slipping(contact.history.state) ? -contact.shear * slipped : 0;
  work.friction += by_friction;
  work.scheme -= contact.shear * contact.slip_change + by_friction;
  const double by_dashpot = contact.normal == 0 ? 0 : -contact.damping * contact.gap_change;
  work.damping -= by_dashpot * contact.gap_change;
  // An impulse changes kinetic energy by p times the mean of the rates before and after.
  const double before =
                   contact.motion.change_along(start.by_gap, from.going_on()) * (rule.starts_at_rest ? 0 : 1),
               energy = contact.normal * rule.impulse_time * (dt * before + contact.gap_change) / 2;
  (energy > 0 ? work.pushed_out : work.damping) += std::abs(energy);
  work.scheme -= (contact.normal - by_dashpot) * contact.gap_change - energy;
}

}  // namespace

StepWork account_motion_step(const BlockSystem& blocks, const StepSystem& system, const MotionStep& step) {
  StepWork work;
  const StepRule& rule = system.rule();
  const double dt = system.dt();
  work.gravity -= system.gravity_forces().dot(step.straight);
  work.external += system.load_forces().dot(step.straight);
  if (!blocks.quiet_faces.empty()) work.damping -= system.quiet_forces(step.straight).dot(step.straight);
  for (const PrescribedDof& held : blocks.prescribed_dofs()) {
    const double reaction = step.residual.force[held.unknown], moved = step.prescribed[held.unknown];
    work.external += reaction * moved;
    work.scheme -= reaction * (step.straight[held.unknown] - moved);
  }
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Range& u = blocks.block(b).unknowns();
    const BlockMotion::Losses losses =
        blocks.block(b).motion()->losses(step.straight.segment(u.first, u.count));
    work.damping += losses.damping;
    work.scheme += losses.scheme;
  }
  for (Contact& contact : step.contacts) account_contact(rule, dt, step.from, step.straight, contact, work);
  return work;
}

std::vector<BlockForceSum> sum_forces(const BlockSystem& blocks, const StepSystem& system,
                                      const VectorXd& straight, const Points& reactions) {
  std::vector<BlockForceSum> sums(static_cast<std::size_t>(blocks.n_blocks()));
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Block& block = blocks.block(b);
    const Range &u = block.unknowns(), &points = block.points();
    const Vec3 momentum = block.motion()->resultant(straight.segment(u.first, u.count));
    const auto size_of = [&](const VectorXd& forces) {
      const auto of_block = forces.segment(u.first, u.count);
      const Vec2 resultant = block.translations().transpose() * of_block;
      return std::max(resultant.norm(), std::abs(block.rotation().dot(of_block)) / block.size());
    };
    sums[b].resultant = std::max(momentum.head<2>().norm(), std::abs(momentum[2]) / block.size());
    sums[b].largest =
        std::max({size_of(system.gravity_forces()), size_of(system.load_forces()),
                  reactions.middleCols(points.first, points.count).colwise().norm().maxCoeff()});
  }
  return sums;
}

}  // namespace ddacontact
