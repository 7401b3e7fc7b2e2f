#include <ddacontact/solver/step_system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// Bits: 1 the normal spring acts, 2 the tangential one does.
unsigned char active_springs(const Contact& contact) {
  if (contact.history.state == ContactState::open) return 0;
  return contact.history.state == ContactState::stick ? 3 : 1;
}

/// Round-off of a gap times this many ulps of the largest coordinate is still round-off.
constexpr double floor_factor = 16 * std::numeric_limits<double>::epsilon();

}  // namespace

StepSystem::StepSystem(const BlockSystem& blocks) : blocks_(blocks), unknown_lengths_(blocks.n_unknowns()) {
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Range& u = blocks.block(b).unknowns();
    unknown_lengths_.segment(u.first, u.count) = blocks.block(b).unknown_lengths();
    if (!blocks.is_unchanging(b)) active_.push_back(b);
  }
}

void StepSystem::set_contacts(const BlockState& state, const std::vector<Contact>& contacts,
                              double held_stiffness) {
  held_stiffness_ = held_stiffness;
  held_springs_.clear();
  for (std::size_t h = 0; h < blocks_.held_vertices.size(); ++h) {
    const HeldVertex& held = blocks_.held_vertices[h];
    for (int axis = 0; axis < 2; ++axis) {
      if (!(axis == 0 ? held.x : held.y)) continue;
      HeldSpring spring{static_cast<int>(h), axis, {}, 0};
      blocks_.block(held.block).vertex_map(held.vertex).add_to(spring.form, Vec2::Unit(axis));
      held_springs_.push_back(spring);
    }
  }

  polyfem::Connectivity connectivity;
  std::vector<int> rows;
  const auto append = [&](const AffineForm& form) {
    rows.clear();
    for (int u : form.unknowns()) rows.push_back(blocks_.equation()[u]);
    connectivity.append(rows);
  };
  for (int b : active_) {
    const Range& u = blocks_.block(b).unknowns();
    connectivity.append({blocks_.equation().data() + u.first, static_cast<std::size_t>(u.count)});
  }
  for (const Contact& contact : contacts) append(contact.gap);
  for (const HeldSpring& spring : held_springs_) append(spring.form);
  if (matrix_.set_connectivity(blocks_.n_equations(), connectivity)) cholesky_.analyze(matrix_.lower());
  factored_springs_.clear();
  coordinate_ = state.position.size() ? state.position.cwiseAbs().maxCoeff() : 0;
}

void StepSystem::set_step(const BlockState& state, const VectorXd& velocity, double dt) {
  dt_ = dt;
  velocity_ = velocity;
  const double time = state.time + dt;
  prescribed_ = blocks_.prescribed(state, time);
  for (HeldSpring& spring : held_springs_) {
    const HeldVertex& held = blocks_.held_vertices[spring.held_vertex];
    const TimeFunction& motion = held.motion;
    const int v = blocks_.block(held.block).vertices().first + held.vertex;
    const double target = motion.at(time, blocks_.end_time)[spring.axis];
    spring.target_change = target - motion.at(state.time, blocks_.end_time)[spring.axis];
    spring.form.constant = state.position(spring.axis, v) - blocks_.reference()(spring.axis, v) - target;
  }

  load_forces_ = VectorXd::Zero(blocks_.n_unknowns());
  gravity_forces_ = load_forces_;
  stress_forces_ = load_forces_;
  blocks_.add_loads(state, time, load_forces_);
  blocks_.add_gravity(gravity_forces_);
  largest_stiffness_ = held_stiffness_;
  for (int b : active_) {
    const Block& block = blocks_.block(b);
    block.add_stress_forces(state, stress_forces_);
    const VectorXd diagonal = block.stiffness().diagonal() + 2 / (dt * dt) * block.mass().diagonal();
    const VectorXd lengths = unknown_lengths_.segment(block.unknowns().first, block.unknowns().count);
    largest_stiffness_ = std::max(largest_stiffness_, diagonal.cwiseQuotient(lengths.cwiseAbs2()).maxCoeff());
  }
  factored_springs_.clear();
}

void StepSystem::compute_residual(const VectorXd& d, const std::vector<Contact>& contacts,
                                  Residual& residual) const {
  VectorXd& r = residual.force;
  r = -(load_forces_ + gravity_forces_ + stress_forces_);
  VectorXd magnitude = VectorXd::Zero(blocks_.n_blocks());
  for (int b : active_) {
    const Block& block = blocks_.block(b);
    const Range& u = block.unknowns();
    const auto lengths = unknown_lengths_.segment(u.first, u.count);
    const auto d_b = d.segment(u.first, u.count);
    const VectorXd elastic = block.stiffness() * d_b;
    const VectorXd inertia =
        2 / (dt_ * dt_) * (block.mass() * (d_b - dt_ * velocity_.segment(u.first, u.count)));
    for (const auto& force : {load_forces_, gravity_forces_, stress_forces_})
      magnitude[b] += force.segment(u.first, u.count).cwiseQuotient(lengths).lpNorm<1>();
    magnitude[b] += elastic.cwiseQuotient(lengths).lpNorm<1>() + inertia.cwiseQuotient(lengths).lpNorm<1>();
    r.segment(u.first, u.count) += elastic + inertia;
  }

  double stiffness = largest_stiffness_;
  for (const Contact& contact : contacts) {
    if (!contact.closed()) continue;
    const double gap = contact.gap(d) - contact.history.gap_offset;
    const double N = normal_force(contact.law, gap);
    contact.gap.add_gradient(-N, r);  // (40): the force on the gap is +N
    const double sign = slip_sign(contact.history.state);
    const double T = sign != 0 ? -sign * shear_bound(contact.law, N, false)
                               : -contact.law.tangential_stiffness * contact.slip(d);
    contact.slip.add_gradient(-T, r);  // (48), (52)
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block}) magnitude[b] += std::hypot(N, T);
    stiffness = std::max(stiffness, contact.law.normal_stiffness);
  }
  for (const HeldSpring& spring : held_springs_) {
    const double force = -held_stiffness_ * spring.form(d);
    spring.form.add_gradient(-force, r);
    magnitude[blocks_.held_vertices[spring.held_vertex].block] += std::abs(force);
  }

  residual.largest = 0;
  residual.scale = 0;
  for (Index k = 0; k < r.size(); ++k)
    if (blocks_.equation()[k] >= 0) {
      const double size = std::abs(r[k]) / unknown_lengths_[k];
      if (!(size <= residual.largest)) residual.largest = size;  // lets a NaN through
    }
  for (int b : active_) residual.scale = std::max(residual.scale, magnitude[b]);
  residual.floor = floor_factor * stiffness * (coordinate_ + (d.size() ? d.cwiseAbs().maxCoeff() : 0));
}

bool StepSystem::factorize(const std::vector<Contact>& contacts) {
  std::vector<unsigned char> springs(contacts.size() + 1,
                                     0);  // never empty: a factor without contacts is one too
  std::transform(contacts.begin(), contacts.end(), springs.begin(), active_springs);
  if (springs == factored_springs_) return true;

  matrix_.set_zero();
  for (int e = 0; e < n_active(); ++e) {
    const Block& block = blocks_.block(active_[e]);
    matrix_.add(e, block.stiffness() + 2 / (dt_ * dt_) * block.mass());  // (28)
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const int e = n_active() + static_cast<int>(c);
    const Contact& contact = contacts[c];
    if (springs[c] & 1)
      matrix_.add_outer(e, contact.law.normal_stiffness, contact.gap.coefficients());  // (39)
    if (springs[c] & 2)
      matrix_.add_outer(e, contact.law.tangential_stiffness, contact.slip.coefficients());  // (47)
  }
  for (std::size_t h = 0; h < held_springs_.size(); ++h)
    matrix_.add_outer(n_active() + static_cast<int>(contacts.size() + h), held_stiffness_,
                      held_springs_[h].form.coefficients());
  factored_springs_.clear();
  if (!cholesky_.factorize(matrix_.lower())) return false;
  factored_springs_ = std::move(springs);
  return true;
}

void StepSystem::solve(const VectorXd& residual_force, VectorXd& correction) {
  const std::vector<int>& equation = blocks_.equation();
  rhs_.resize(blocks_.n_equations());
  for (Index k = 0; k < residual_force.size(); ++k)
    if (equation[k] >= 0) rhs_[equation[k]] = residual_force[k];
  cholesky_.solve(rhs_, solution_);
  correction.setZero(residual_force.size());
  for (Index k = 0; k < correction.size(); ++k)
    if (equation[k] >= 0) correction[k] = solution_[equation[k]];
}

}  // namespace ddacontact
