#include <ddacontact/time/stepper.hpp>

#include <ddacontact/time/stopwatch.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ddacontact {

namespace {

/// A substep shorter than this times time_step is not tried.
constexpr double smallest_substep = 1e-4;
/// The default preset looks for contacts as far as twice the motion expected, at least and at most these parts
/// of the block's size.
constexpr double least_reach = 0.01, largest_reach = 0.25;

}  // namespace

Stepper::Stepper(BlockSystem blocks, BlockState initial, ContactProperties contacts, AnalysisOptions analysis)
    : blocks_(std::move(blocks)),
      analysis_(analysis),
      contact_builder_(blocks_, contacts),
      system_(blocks_),
      state_(std::move(initial)),
      held_stiffness_(contacts.normal_stiffness),
      substep_(analysis.time_step),
      reactions_(Points::Zero(2, state_.position.cols())) {
  const Points& x = blocks_.reference();
  const double larger_side = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  largest_displacement_ = analysis.max_displacement_ratio * larger_side / 2;
  blocks_.prepare(state_, true);
  contacts_ = contact_builder_.build_first(state_, reach(analysis.time_step));
  energy_.now.kinetic = kinetic_energy(state_.velocity);
  energy_.now.elastic = elastic_energy();
  energy_.start();
}

std::vector<double> Stepper::reach(double dt) const {
  std::vector<double> reach(blocks_.n_blocks(), largest_displacement_);
  const VectorXd prescribed = blocks_.prescribed(state_, state_.time + dt);
  const double fall = blocks_.gravity.norm() * dt * dt;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    if (!blocks_.is_movable(b)) {
      reach[b] = prescribed.segment(block.unknowns().first, block.unknowns().count).lpNorm<Eigen::Infinity>() *
                 std::numbers::sqrt2;
      continue;
    }
    if (analysis_.preset == Preset::paper) continue;
    double fastest = 0;
    for (int v = 0; v < block.n_vertices(); ++v)
      fastest = std::max(fastest, block.vertex_map(v)(state_.velocity).norm());
    const double expected = trial_reach_scale_ * (2 * (fastest * dt + fall) + least_reach * block.size());
    reach[b] = std::min({expected, largest_reach * block.size(), largest_displacement_});
  }
  return reach;
}

void Stepper::detect(double dt) {
  const Stopwatch watch(times_.detection);
  trial_contacts_ = counts_.substeps == 0 ? contact_builder_.build_first(state_, reach(dt))
                                          : contact_builder_.build(state_, reach(dt), contacts_);
}

bool Stepper::step() {
  const double end = (counts_.steps + 1) * analysis_.time_step;
  while (true) {
    const double remaining = end - state_.time;
    const double pieces = std::max(1.0, std::ceil(remaining / substep_ - 1e-9));
    double dt = remaining / pieces;
    const bool last_resort = dt * analysis_.cutting_factor < smallest_substep * analysis_.time_step;
    const Try result = try_step(dt, last_resort);
    if (result == Try::accepted) {
      detected_ = false;
      trial_reach_scale_ = 1;
      if (pieces == 1) {
        state_.time = end;
        substep_ = std::min(analysis_.time_step, std::max(substep_, 2 * dt));
        ++counts_.steps;
        return true;
      }
      substep_ = 2 * dt;
      continue;
    }
    ++counts_.rejected;
    if (result == Try::outran_detection) {
      trial_reach_scale_ *= 4;
      detected_ = false;
      continue;
    }
    if (last_resort) {
      stop_reason_ = rejection_ + ", even with a substep of " + std::to_string(dt) + " s";
      return false;
    }
    substep_ = dt * analysis_.cutting_factor;
  }
}

Stepper::Try Stepper::try_step(double dt, bool last_resort) {
  const bool carries_velocity = analysis_.mode == Mode::dynamic;
  const VectorXd velocity = carries_velocity ? state_.velocity : VectorXd::Zero(state_.velocity.size());
  const std::vector<double> reached = reach(dt);
  if (!detected_) {
    detect(dt);
    const Stopwatch watch(times_.assembly);
    system_.set_contacts(state_, trial_contacts_, held_stiffness_);
    detected_ = true;
  }
  {
    const Stopwatch watch(times_.assembly);
    system_.set_step(state_, velocity, dt);
  }
  tried_ = trial_contacts_;
  VectorXd d;
  OpenCloseReport report;
  {
    const Stopwatch watch(times_.solver);
    report = iterate_open_close(system_, open_close_, tried_, d);
  }
  counts_.open_close_iterations += report.iterations;

  const Stopwatch watch(times_.update);
  switch (report.status) {
    case OpenCloseStatus::settled: break;
    case OpenCloseStatus::friction_unsettled:
      rejection_ = "stick and slip did not settle" + where(report);
      if (!last_resort) return Try::rejected;
      ++counts_.unconverged;
      break;
    case OpenCloseStatus::unsettled:
      rejection_ = "open and closed contacts did not settle" + where(report);
      return Try::rejected;
    case OpenCloseStatus::not_positive_definite:
      rejection_ = "the equations are not positive definite";
      return Try::rejected;
    case OpenCloseStatus::not_finite:
      rejection_ = "the solution is not finite";
      return Try::rejected;
  }

  Points displacement(2, state_.position.cols());
  bool outran = false;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    double furthest = 0;
    for (int v = 0; v < block.n_vertices(); ++v) {
      const Vec2 u = block.vertex_map(v)(d);
      displacement.col(block.vertices().first + v) = u;
      furthest = std::max(furthest, u.norm());
    }
    if (!blocks_.is_movable(b)) continue;
    if (furthest > largest_displacement_) {
      rejection_ = "block \"" + blocks_.names[b] + "\" moves further in one step than max_displacement_ratio allows";
      return Try::rejected;
    }
    if (analysis_.preset != Preset::paper && furthest > reached[b]) {
      rejection_ = "block \"" + blocks_.names[b] + "\" moves further in one step than contacts are looked for";
      outran = true;
      if (reached[b] >= std::min(largest_reach * block.size(), largest_displacement_)) return Try::rejected;
    }
  }
  if (outran) return Try::outran_detection;
  return accept(dt, d, displacement, report) ? Try::accepted : Try::rejected;
}

std::string Stepper::where(const OpenCloseReport& report) const {
  if (report.last_changed < 0) return "";
  const VertexEdge& pair = tried_[report.last_changed].pair;
  return ", last between blocks \"" + blocks_.names[pair.vertex_block] + "\" and \"" + blocks_.names[pair.edge_block] +
         "\"";
}

bool Stepper::accept(double dt, const VectorXd& d, const Points& displacement, const OpenCloseReport& report) {
  BlockState next = state_;
  next.time += dt;
  next.position += displacement;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    if (blocks_.is_unchanging(b)) continue;
    const auto outline = next.position.middleCols(block.vertices().first, block.vertices().count);
    if (const auto corner = polyfem::find_non_convex_corner(outline)) {
      rejection_ = "a corner of block \"" + blocks_.names[b] + "\" turns concave";
      return false;
    }
    block.add_stress(d, next.stress);
    const auto reference = blocks_.reference().middleCols(block.vertices().first, block.vertices().count);
    const double turn = best_fit_rotation(reference, outline) - state_.rotation[b];
    next.rotation[b] = state_.rotation[b] + std::remainder(turn, 2 * std::numbers::pi);
  }

  // Newmark (1/2, 1): v1 = 2 d / dt - v0, and v0 = 0 in a static step, after which the blocks are at rest.
  const bool carries_velocity = analysis_.mode == Mode::dynamic;
  const VectorXd velocity = carries_velocity ? state_.velocity : VectorXd::Zero(d.size());
  next.velocity = carries_velocity ? VectorXd(2 / dt * d - velocity) : VectorXd::Zero(d.size());
  for (const HeldUnknown& held : blocks_.held_unknowns()) next.velocity[held.unknown] = d[held.unknown] / dt;

  account_energy(dt, d, velocity, next.velocity, report.residual);

  reactions_.setZero();
  for (const HeldUnknown& held : blocks_.held_unknowns())
    reactions_(held.axis, held.vertex) += report.residual.force[held.unknown];
  for (const StepSystem::HeldSpring& spring : system_.held_springs()) {
    const HeldVertex& held = blocks_.held_vertices[spring.held_vertex];
    reactions_(spring.axis, blocks_.block(held.block).vertices().first + held.vertex) -=
        system_.held_stiffness() * spring.form(d);
  }

  long closed = 0;
  for (Contact& contact : tried_) {
    contact.end_gap = contact.gap(d) - contact.history.gap_offset;
    contact.end_slip = contact.slip(d);
    contact.normal = contact.shear = 0;
    if (!contact.closed()) {
      contact.history.bonded = false;
      contact.history.gap_offset = 0;
      continue;
    }
    ++closed;
    contact.normal = normal_force(contact.law, contact.end_gap);
    contact.shear = is_slipping(contact.history.state)
                        ? -slip_sign(contact.history.state) * shear_bound(contact.law, contact.normal, false)
                        : -contact.law.tangential_stiffness * contact.end_slip;
    counts_.max_penetration = std::max(counts_.max_penetration, -contact.end_gap);
  }
  counts_.contacts = closed;
  counts_.contacts_max = std::max(counts_.contacts_max, closed);
  ++counts_.substeps;
  contacts_ = tried_;
  state_ = std::move(next);
  last_dt_ = dt;
  blocks_.prepare(state_);
  energy_.now.kinetic = kinetic_energy(state_.velocity);
  energy_.now.elastic = elastic_energy();
  energy_.close_step();
  return true;
}

void Stepper::account_energy(double dt, const VectorXd& d, const VectorXd& old_velocity, const VectorXd& new_velocity,
                             const Residual& residual) {
  Energy& energy = energy_.now;
  energy.gravity -= system_.gravity_forces().dot(d);
  energy.external += system_.load_forces().dot(d);
  for (const HeldUnknown& held : blocks_.held_unknowns())
    energy.external += residual.force[held.unknown] * d[held.unknown];

  // The scheme takes every force at its end value over the whole step: what its work differs from the change of
  // the energy it belongs to is lost. Elastic: d.(f0 + K d) - (d.f0 + d.K d / 2). Inertia: d.M a less the change
  // of the kinetic energy, with a = 2 (d / dt^2 - v0 / dt): zero but for held and static unknowns.
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (blocks_.is_unchanging(b)) continue;
    const Block& block = blocks_.block(b);
    const Range& u = block.unknowns();
    const auto d_b = d.segment(u.first, u.count), v0 = old_velocity.segment(u.first, u.count),
               v1 = new_velocity.segment(u.first, u.count);
    const VectorXd acceleration = 2 / (dt * dt) * (d_b - dt * v0);
    energy.numerical_dissipated += d_b.dot(block.stiffness() * d_b) / 2;
    energy.numerical_dissipated += d_b.dot(block.mass() * acceleration) -
                                   (v1.dot(block.mass() * v1) - v0.dot(block.mass() * v0)) / 2;
  }
  for (const StepSystem::HeldSpring& spring : system_.held_springs()) {
    const double change = spring.form.change(d) - spring.target_change;
    energy.numerical_dissipated += system_.held_stiffness() * change * change / 2;
    energy.external -= system_.held_stiffness() * spring.form(d) * spring.target_change;
  }

  for (std::size_t c = 0; c < tried_.size(); ++c) {
    const Contact &before = trial_contacts_[c], &after = tried_[c];
    const JointLaw& law = after.law;
    const auto normal_energy = [&](double gap) { return law.normal_stiffness * gap * gap / 2; };
    const auto shear_energy = [&](double slip) { return law.tangential_stiffness * slip * slip / 2; };
    const double gap_before = before.gap.constant - before.history.gap_offset;
    const double gap_after = after.gap(d) - after.history.gap_offset;
    double stored_normal = before.closed() ? normal_energy(gap_before) : 0;
    double stored_shear = before.history.state == ContactState::stick ? shear_energy(before.slip.constant) : 0;
    if (!after.closed()) {
      energy.numerical_dissipated += stored_normal + stored_shear;
      continue;
    }
    const double N = normal_force(law, gap_after);
    energy.numerical_dissipated += stored_normal - normal_energy(gap_after) - N * after.gap.change(d);
    const double slip_change = after.slip.change(d);
    if (after.history.state == ContactState::stick) {
      const double slip = after.slip(d);
      energy.numerical_dissipated += stored_shear - shear_energy(slip) + law.tangential_stiffness * slip * slip_change;
    } else {
      energy.friction_dissipated +=
          stored_shear + slip_sign(after.history.state) * shear_bound(law, N, false) * slip_change;
    }
  }
}

double Stepper::kinetic_energy(const VectorXd& velocity) const {
  double energy = 0;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (blocks_.is_unchanging(b)) continue;
    const Range& u = blocks_.block(b).unknowns();
    const auto v = velocity.segment(u.first, u.count);
    energy += v.dot(blocks_.block(b).mass() * v) / 2;
  }
  return energy;
}

double Stepper::elastic_energy() const {
  double energy = 0;
  for (int b = 0; b < blocks_.n_blocks(); ++b) energy += blocks_.block(b).elastic_energy(state_);
  for (const Contact& contact : contacts_) {
    if (!contact.closed()) continue;
    energy += contact.law.normal_stiffness * contact.end_gap * contact.end_gap / 2;
    if (contact.history.state == ContactState::stick)
      energy += contact.law.tangential_stiffness * contact.end_slip * contact.end_slip / 2;
  }
  for (const StepSystem::HeldSpring& spring : system_.held_springs()) {
    const HeldVertex& held = blocks_.held_vertices[spring.held_vertex];
    const int v = blocks_.block(held.block).vertices().first + held.vertex;
    const double stretch = state_.position(spring.axis, v) - blocks_.reference()(spring.axis, v) -
                           held.motion.at(state_.time, blocks_.end_time)[spring.axis];
    energy += system_.held_stiffness() * stretch * stretch / 2;
  }
  return energy;
}

}  // namespace ddacontact
