#include <ddacontact/time/energy_accounts.hpp>

#include <ddacontact/core/for_all.hpp>
#include <ddacontact/equations/bolt_law.hpp>
#include <ddacontact/time/joint_springs.hpp>

#include <cassert>
#include <numeric>

namespace ddacontact {

namespace {

/// In the order of the blocks.
double sum_over_blocks(int n_blocks, const auto& value) {
  VectorXd values(n_blocks);
  for_all(n_blocks, [&](int b) { values[b] = value(b); });
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// What elastic forces took from the block's motion and do not store, with the work of inertia; and what its
/// damping took.
Vec2 block_losses(const BlockStep& step, const Range& u, const VectorXd& of_all,
                  const VectorXd& motion_of_all) {
  const auto d = u.of(of_all), motion = u.of(motion_of_all);
  thread_local BlockForces forces;
  step.forces(d, forces);
  // A shift before the step stores nothing.
  const double by_shift = forces.elastic().dot(motion - d);
  return {step.elastic_loss(d, forces.elastic()) + by_shift + motion.dot(forces.inertia()),
          motion.dot(forces.damping())};
}

/// What the springs of a contact store in a state at this gap or slip.
double stored_normal(const ContactProperties& properties, ContactState state, double gap) {
  const bool stores = state != ContactState::open && !properties.has_multipliers();
  return stores ? properties.normal_stiffness * gap * gap / 2 : 0;
}
double stored_shear(const ContactProperties& properties, ContactState state, double slip) {
  const bool stores = state == ContactState::stick && !properties.has_multipliers();
  return stores ? properties.tangential_stiffness * slip * slip / 2 : 0;
}

void account_contact(const ContactProperties& properties, bool means, const Contact& contact,
                     Energy& energy) {
  if (contact.law.compliant) {
    account_joint_springs(contact, means, energy);
    return;
  }
  // Of a contact that closes within the step no more than what it does.
  const double by_dashpot =
      contact.normal == 0 ? 0
                          : std::min(-contact.damping * contact.gap_change, std::max(contact.normal, 0.0));
  energy.damping_dissipated -= by_dashpot * contact.gap_change;
  const ContactState before = contact.start_state, after = contact.history.state;
  const double offset = contact.history.gap_offset;
  energy.numerical_dissipated += stored_normal(properties, before, contact.first_gap().constant - offset) -
                                 stored_normal(properties, after, contact.gap - offset) -
                                 (contact.normal - by_dashpot) * contact.gap_change;
  const double from_shear = stored_shear(properties, before, contact.first_slip().constant) -
                            stored_shear(properties, after, contact.end_slip) -
                            contact.shear * contact.slip_change;
  (is_slipping(after) ? energy.friction_dissipated : energy.numerical_dissipated) += from_shear;
}

}  // namespace

double kinetic_energy(const BlockSystem& blocks, const VectorXd& velocity) {
  return sum_over_blocks(blocks.n_blocks(), [&](int b) {
    const Range& u = blocks.block(b).unknowns();
    return blocks.is_unchanging(b) ? 0 : blocks.block(b).kinetic_energy(u.of(velocity));
  });
}

double spring_energy(const std::vector<ContactRecord>& contacts, const ContactProperties& properties) {
  double energy = 0;
  const bool any_compliant = properties.joints.any(&JointStrength::is_compliant);
  for (const ContactRecord& contact : contacts)
    energy += any_compliant && properties.is_compliant(contact)
                  ? energy_of_joint(properties, contact)
                  : stored_normal(properties, contact.history.state, contact.end_gap) +
                        stored_shear(properties, contact.history.state, contact.end_slip);
  return energy;
}

double elastic_energy(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<ContactRecord>& contacts, const ContactProperties& properties) {
  double energy = sum_over_blocks(blocks.n_blocks(), [&](int b) {
    return blocks.is_present(b) ? blocks.block(b).elastic_energy(state) : 0;
  });
  energy += spring_energy(contacts, properties);
  for (const FixedVertex& held : blocks.fixed_vertices) {
    const int v = blocks.block(held.block).vertices().first + held.vertex;
    const Vec2 target = held.motion.at(state.time, blocks.end_time);
    for (int axis = 0; axis < 2; ++axis) {
      const double stretch = blocks.total_displacement(state, v, axis) - target[axis];
      if (axis == 0 ? held.x : held.y) energy += properties.normal_stiffness * stretch * stretch / 2;
    }
  }
  return energy + bolt_energy(blocks, state);
}

void account_step(const StepSystem& system, const TrialSolution& solution, const VectorXd& motion,
                  const std::vector<Contact>& contacts, const ContactProperties& properties, Energy& energy) {
  const BlockSystem& blocks = system.blocks();
  const VectorXd& d = solution.d;
  assert(motion.size() == d.size() && solution.residual.force.size() == d.size());
  for (const PrescribedDof& held : blocks.prescribed_dofs())
    energy.external += solution.residual.force[held.unknown] * motion[held.unknown];
  Points losses = Points::Zero(2, blocks.n_blocks());
  for_all(blocks.n_blocks(), [&](int b) {
    if (!blocks.is_unchanging(b))
      losses.col(b) = block_losses(system.step(b), blocks.block(b).unknowns(), d, motion);
  });
  for (const auto& of_block : losses.colwise()) {
    energy.numerical_dissipated += of_block[0];
    energy.damping_dissipated += of_block[1];
  }
  for (const StepSystem::FixedPointSpring& spring : system.fixed_point_springs()) {
    const double change = spring.form.change(d) - spring.target_change;
    energy.numerical_dissipated += system.fixed_point_stiffness() * change * change / 2;
    energy.external -= system.fixed_point_stiffness() * spring.form(d) * spring.target_change;
  }
  for (const Contact& contact : contacts)
    account_contact(properties, system.rule().mean_forces(), contact, energy);
}

}  // namespace ddacontact
