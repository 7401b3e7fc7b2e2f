#include <ddacontact/time/energy_accounts.hpp>

namespace ddacontact {

namespace {

double normal_energy(const JointLaw& law, double gap) {
  return law.normal_stiffness * gap * gap / 2;
}
double shear_energy(const JointLaw& law, double slip) {
  return law.tangential_stiffness * slip * slip / 2;
}

/// Elastic: d.(f0 + K d) less d.f0 + d.K d / 2. Inertia: d.M a with a = 2 (d / dt^2 - v0 / dt), less the
/// change of the kinetic energy: zero but for held unknowns and for velocities set to zero.
double lost_in_block(const Block& block, const AcceptedStep& step) {
  const Range& u = block.unknowns();
  const auto d = step.d.segment(u.first, u.count);
  const auto v0 = step.start_velocity.segment(u.first, u.count),
             v1 = step.end_velocity.segment(u.first, u.count);
  const MatrixXd &K = block.stiffness(), &M = block.mass();
  const VectorXd acceleration = 2 / (step.dt * step.dt) * (d - step.dt * v0);
  return d.dot(K * d) / 2 + d.dot(M * acceleration) - (v1.dot(M * v1) - v0.dot(M * v0)) / 2;
}

void account_contact(const Contact& before, const Contact& after, const VectorXd& d, Energy& energy) {
  const JointLaw& law = after.law;
  const double stored_normal =
      before.closed() ? normal_energy(law, before.gap.constant - before.history.gap_offset) : 0;
  const double stored_shear =
      before.history.state == ContactState::stick ? shear_energy(law, before.slip.constant) : 0;
  if (!after.closed()) {
    energy.numerical_dissipated += stored_normal + stored_shear;
    return;
  }
  const double gap = after.gap(d) - after.history.gap_offset;
  const double N = normal_force(law, gap);
  energy.numerical_dissipated += stored_normal - normal_energy(law, gap) - N * after.gap.change(d);

  const double slip_change = after.slip.change(d);
  if (after.history.state == ContactState::stick) {
    const double slip = after.slip(d);
    energy.numerical_dissipated +=
        stored_shear - shear_energy(law, slip) + law.tangential_stiffness * slip * slip_change;
  } else {
    energy.friction_dissipated +=
        stored_shear + slip_sign(after.history.state) * shear_bound(law, N, false) * slip_change;
  }
}

}  // namespace

double kinetic_energy(const BlockSystem& blocks, const VectorXd& velocity) {
  double energy = 0;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Range& u = blocks.block(b).unknowns();
    const auto v = velocity.segment(u.first, u.count);
    energy += v.dot(blocks.block(b).mass() * v) / 2;
  }
  return energy;
}

double elastic_energy(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<Contact>& contacts, double held_stiffness) {
  double energy = 0;
  for (int b = 0; b < blocks.n_blocks(); ++b) energy += blocks.block(b).elastic_energy(state);
  for (const Contact& contact : contacts) {
    if (contact.closed()) energy += normal_energy(contact.law, contact.end_gap);
    if (contact.history.state == ContactState::stick) energy += shear_energy(contact.law, contact.end_slip);
  }
  for (const HeldVertex& held : blocks.held_vertices) {
    const int v = blocks.block(held.block).vertices().first + held.vertex;
    const Vec2 target = held.motion.at(state.time, blocks.end_time);
    const Vec2 stretch = state.position.col(v) - blocks.reference().col(v) - target;
    if (held.x) energy += held_stiffness * stretch.x() * stretch.x() / 2;
    if (held.y) energy += held_stiffness * stretch.y() * stretch.y() / 2;
  }
  return energy;
}

void account_step(const BlockSystem& blocks, const StepSystem& system, const AcceptedStep& step,
                  Energy& energy) {
  energy.gravity -= system.gravity_forces().dot(step.d);
  energy.external += system.load_forces().dot(step.d);
  for (const HeldUnknown& held : blocks.held_unknowns())
    energy.external += step.residual.force[held.unknown] * step.d[held.unknown];
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (!blocks.is_unchanging(b)) energy.numerical_dissipated += lost_in_block(blocks.block(b), step);
  for (const StepSystem::HeldSpring& spring : system.held_springs()) {
    const double change = spring.form.change(step.d) - spring.target_change;
    energy.numerical_dissipated += system.held_stiffness() * change * change / 2;
    energy.external -= system.held_stiffness() * spring.form(step.d) * spring.target_change;
  }
  for (std::size_t c = 0; c < step.after.size(); ++c)
    account_contact(step.before[c], step.after[c], step.d, energy);
}

}  // namespace ddacontact
