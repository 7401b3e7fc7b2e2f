#include <ddacontact/time/energy_accounts.hpp>

#include <ddacontact/block/for_blocks.hpp>

namespace ddacontact {

namespace {

double normal_energy(const JointLaw& law, double gap) {
  return law.normal_stiffness * gap * gap / 2;
}
double shear_energy(const JointLaw& law, double slip) {
  return law.tangential_stiffness * slip * slip / 2;
}

/// What forces took from the block's motion less what it has of it after the step: elastic, and by inertia;
/// and what its damping took.
Vec2 block_losses(const Block& block, const AcceptedStep& step) {
  const Range& u = block.unknowns();
  const auto d = step.d.segment(u.first, u.count);
  thread_local BlockForces forces;
  block.forces(d, forces);
  return {block.elastic_loss(d, forces.elastic) + d.dot(forces.inertia) -
              (block.kinetic_energy(step.end_velocity.segment(u.first, u.count)) -
               block.kinetic_energy(step.start_velocity.segment(u.first, u.count))),
          d.dot(forces.damping)};
}

/// What the springs of a contact store when its gap and slip are these.
double stored_normal(const ContactRecord& contact, double gap) {
  return contact.closed() && !contact.augmented ? normal_energy(contact.law, gap) : 0;
}
double stored_shear(const ContactRecord& contact, double slip) {
  return contact.history.state == ContactState::stick && !contact.augmented ? shear_energy(contact.law, slip)
                                                                            : 0;
}

void account_contact(const ContactStart& start, const Contact& after, Energy& energy) {
  const double by_dashpot = after.normal != 0 ? -after.damping * after.gap_change : 0;
  energy.damping_dissipated -= by_dashpot * after.gap_change;
  double normal_before = 0, shear_before = 0;
  if (!after.augmented) {
    ContactRecord before = after;
    start.write(before.history);
    normal_before = stored_normal(before, after.first_gap().constant - start.gap_offset);
    shear_before = stored_shear(before, after.first_slip().constant);
  }
  energy.numerical_dissipated +=
      normal_before - stored_normal(after, after.end_gap) - (after.normal - by_dashpot) * after.gap_change;
  const double from_shear =
      shear_before - stored_shear(after, after.end_slip) - after.shear * after.slip_change;
  (is_slipping(after.history.state) ? energy.friction_dissipated : energy.numerical_dissipated) += from_shear;
}

}  // namespace

double kinetic_energy(const BlockSystem& blocks, const VectorXd& velocity) {
  return sum_over_blocks(blocks.n_blocks(), [&](int b) {
    const Range& u = blocks.block(b).unknowns();
    return blocks.is_unchanging(b) ? 0 : blocks.block(b).kinetic_energy(velocity.segment(u.first, u.count));
  });
}

double elastic_energy(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<ContactRecord>& contacts, double held_stiffness) {
  double energy = sum_over_blocks(blocks.n_blocks(), [&](int b) {
    return blocks.is_present(b) ? blocks.block(b).elastic_energy(state) : 0;
  });
  for (const ContactRecord& contact : contacts) {
    energy += stored_normal(contact, contact.end_gap) + stored_shear(contact, contact.end_slip);
  }
  for (const HeldVertex& held : blocks.held_vertices) {
    const int v = blocks.block(held.block).vertices().first + held.vertex;
    const Vec2 target = held.motion.at(state.time, blocks.end_time);
    for (int axis = 0; axis < 2; ++axis) {
      const double stretch = blocks.total_displacement(state, v, axis) - target[axis];
      if (axis == 0 ? held.x : held.y) energy += held_stiffness * stretch * stretch / 2;
    }
  }
  return energy;
}

void account_step(const BlockSystem& blocks, const StepSystem& system, const AcceptedStep& step,
                  Energy& energy) {
  energy.gravity -= system.gravity_forces().dot(step.d);
  energy.external += system.load_forces().dot(step.d);
  for (const HeldUnknown& held : blocks.held_unknowns())
    energy.external += step.residual.force[held.unknown] * step.d[held.unknown];
  Points losses = Points::Zero(2, blocks.n_blocks());
  for_blocks(blocks.n_blocks(), [&](int b) {
    if (!blocks.is_unchanging(b)) losses.col(b) = block_losses(blocks.block(b), step);
  });
  for (const auto& of_block : losses.colwise()) {
    energy.numerical_dissipated += of_block[0];
    energy.damping_dissipated += of_block[1];
  }
  for (const StepSystem::HeldSpring& spring : system.held_springs()) {
    const double change = spring.form.change(step.d) - spring.target_change;
    energy.numerical_dissipated += system.held_stiffness() * change * change / 2;
    energy.external -= system.held_stiffness() * spring.form(step.d) * spring.target_change;
  }
  for (std::size_t c = 0; c < step.after.size(); ++c) account_contact(step.before[c], step.after[c], energy);
}

}  // namespace ddacontact
