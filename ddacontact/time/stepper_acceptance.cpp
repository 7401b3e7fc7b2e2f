// What an accepted step leaves: the next state, its accounts, and what the next step carries on.
#include <ddacontact/block/for_blocks.hpp>
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/joint_springs.hpp>
#include <ddacontact/time/stepper.hpp>
#include <ddacontact/time/support_velocity.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

namespace ddacontact {

bool Stepper::check_concave(int b, const BlockState& next) {
  const Range& v = blocks_.block(b).vertices();
  const auto outline = next.position.middleCols(v.first, v.count);
  if (!(polyfem::signed_area(outline) > 0)) {
    rejection_ = "block " + quoted(blocks_.names[b]) + " is turned inside out: it is too soft for its loads";
    return false;
  }
  if (polyfem::find_defect(outline)) {
    rejection_ = "the outline of block " + quoted(blocks_.names[b]) + " crosses itself";
    return false;
  }
  if (convex_[in_whole(b)]) turned_concave_.push_back(b);
  return true;
}

bool Stepper::advance(double dt, const Solution& solution, BlockState& next) {
  next.time += dt;
  turned_concave_.clear();
  const VectorXd& d = solution.d;
  blocks_.end_step(solution.straight, solution.residual.external, next);
  std::vector<char> is_concave(blocks_.n_blocks(), 0);
  for_blocks(blocks_.n_blocks(), [&](int b) {
    if (blocks_.is_unchanging(b)) return;
    const Range& v = blocks_.block(b).vertices();
    const auto outline = next.position.middleCols(v.first, v.count);
    is_concave[b] = polyfem::find_non_convex_corner(outline).has_value();
    const double angle = best_fit_rotation(blocks_.block(b).reference().leftCols(v.count), outline);
    next.rotation[b] += std::remainder(angle - state_.rotation[b], 2 * std::numbers::pi);
  });
  for (int b = 0; b < blocks_.n_blocks(); ++b)
    if (is_concave[b] && !check_concave(b, next)) return false;
  const StepRule rule = step_rule(analysis_, dt, state_.carried_dt);
  next.carried_dt = rule.has_half_steps() && !is_static() ? dt : 0;
  for (const PrescribedDof& held :
       blocks_.prescribed_dofs()) {  // to the bit, without the rounding of the motions
    const int b = blocks_.block_of_unknown(held.unknown);
    if (!rule.has_half_steps() || blocks_.is_unchanging(b)) continue;
    next.position(held.axis, held.vertex) = state_.position(held.axis, held.vertex) +
                                            system_->prescribed()[held.unknown] +
                                            (state_.origin(held.axis, b) - next.origin(held.axis, b));
  }
  if (is_static()) {  // after a static step blocks are at rest
    next.velocity.setZero();
    next.carried.setZero();
    return true;
  }
  if (rule.has_half_steps()) {
    next.velocity = next.carried;
    return true;
  }
  for (const PrescribedDof& held : blocks_.prescribed_dofs()) {
    // Where the trapezoidal rule goes on with this velocity d - dt v0 is a contact's force: a mean over the
    // step would be half a step late, and make it twice as large as the support's acceleration does.
    const bool of_both_sides = rule.mean_forces() && held.motion.is_history();
    next.velocity[held.unknown] =
        of_both_sides ? support_velocity(held, next.time, dt, blocks_.end_time) : d[held.unknown] / dt;
  }
  return true;
}

void Stepper::accept(double dt, const Solution& solution, BlockState next) {
  accepting_ = true;
  record_reactions(solution.straight, solution.residual);
  const bool has_impact = solution.impact.changes();
  const BlockState& from = has_impact ? solution.impact.start : state_;
  if (has_motions()) {
    for (Contact& contact : trial_contacts_)
      if (has_impact) contact_builder_->start_from(from, contact);
    book(account_motion_step(
        blocks_, *system_,
        {from, solution.straight, system_->prescribed(), solution.residual, trial_contacts_}));
    if (has_impact) book_shift(solution.impact.shift);
    end_bolts(solution, solution.straight, next);
  } else {
    VectorXd motion = solution.d;
    if (has_impact) {
      motion += solution.impact.shift;
      measure_contacts(from, solution.d, motion);
    }
    account_step(blocks_, *system_, {dt, solution.d, motion, solution.residual, trial_contacts_, properties_},
                 energy_.now);
    end_bolts(solution, motion, next);
  }
  assess(dt, solution, next);
  book_kinetic(kinetic_energy(blocks_, next.velocity));
  record_contacts();
  // How much of what an impact takes is friction's is told by its impulses, which need not be unique.
  const double of_impact = solution.impact.friction_loss + solution.impact.normal_loss;
  const double by_friction =
      std::clamp(solution.impact.friction_loss, std::min(0.0, of_impact), std::max(0.0, of_impact));
  energy_.now.numerical_dissipated -= of_impact;
  energy_.now.friction_dissipated += by_friction;
  energy_.now.damping_dissipated += of_impact - by_friction;
  counts_.impacts += solution.impact.n_hits;
  if (solution.impact.limited) ++counts_.limited_impacts;
  if (!solution.impact.settled) ++counts_.unsettled_impacts;
  for (int b : turned_concave_) {
    convex_[in_whole(b)] = false;
    notes_.push_back("block " + quoted(blocks_.names[b]) + " is no longer convex at time " +
                     std::to_string(next.time) + " s: it goes on with " +
                     (analysis_.kinematics == Kinematics::corotational
                          ? "the functions of its starting shape"
                          : "mean value functions while a corner is concave"));
  }
  contacts_.assign(trial_contacts_.begin(), trial_contacts_.end());
  state_ = std::move(next);
  prepare_and_keep_momentum();
  energy_.now.kinetic = kinetic_energy(blocks_, state_.velocity);
  energy_.now.elastic = elastic_energy(blocks_, state_, contacts_, properties_, fixed_point_stiffness_);
  if (asleep_) energy_.now.elastic += asleep_->elastic_outside;
  const bool some_fell_asleep = fall_asleep(dt);
  tolerated_work_ = 0;
  for (const Contact& contact : trial_contacts_)
    tolerated_work_ += std::max(contact.normal, 0.0) * solver_options_.penetration_tolerance * contact.size;
  ++counts_.substeps;
  counts_.max_residual = std::max(counts_.max_residual, solution.residual.block_relative);
  counts_.largest_tolerance = std::max(counts_.largest_tolerance, solution.tolerance);
  begun_ = true;
  last_dt_ = dt;
  detected_ = false;
  reach_scale_ = 1;
  all_contacts_known_ = false;
  counts_.equations = blocks_.n_equations();
  if (some_fell_asleep) regroup();
  counts_.asleep = sleeping_.n_asleep();
  accepting_ = false;
}

void Stepper::look_ahead(double dt) {
  if (state_.carried_dt > 0) {
    try {
      ahead_ = Ahead{dt, find_solution(dt), counts_};
      ahead_->solution.start.resize(0);  // has served
    } catch (const std::bad_alloc&) {    // the step itself will say so
      discard_trials();
    }
    counts_ = accepted_.counts;
    if (ahead_ && (ahead_->solution.rejection.empty() || ahead_->solution.friction_unsettled)) {
      const Solution& solution = ahead_->solution;
      // An impact is yet to come.
      const double before = state_.carried_dt;
      state_.velocity = (dt * state_.carried + before * (solution.straight / dt)) / (dt + before);
      // Central differences keep the energy less (v - v_before) M (v - v_before) / 8.
      if (stable_) tolerated_work_ += kinetic_energy(blocks_, solution.straight / dt - state_.carried) / 4;
      if (solution.impact.changes()) before_impact(solution.impact.jump);
      book_kinetic(kinetic_energy(blocks_, state_.velocity));
    } else {
      accepted_.counts.unknown_velocities = ++counts_.unknown_velocities;
      if (ahead_) ++ahead_->counts.unknown_velocities;
    }
  }
  energy_.close_step(tolerated_work_);
}

void Stepper::before_impact(const VectorXd& jump) {
  std::vector<char> touches(static_cast<std::size_t>(blocks_.n_blocks()), 0);
  for (const ContactRecord& contact : contacts_)
    if (contact.closed()) touches[contact.pair.vertex_block] = touches[contact.pair.edge_block] = 1;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    const Range& u = block.unknowns();
    if (jump.segment(u.first, u.count).isZero(0)) continue;
    auto velocity = state_.velocity.segment(u.first, u.count);
    velocity = state_.carried.segment(u.first, u.count);
    if (!touches[b] && blocks_.is_free(b))
      velocity += state_.carried_dt / 2 * block.translations() * blocks_.gravity;
  }
}

void Stepper::end_bolts(const Solution& solution, const VectorXd& motion, BlockState& next) {
  const std::vector<StepBolt>& bolts = system_->bolts_at(solution.straight);
  if (bolts.empty()) return;
  double dissipated = 0;
  for (const StepBolt& bolt : bolts) {
    const BoltLosses losses = bolt.end(next.bolts);
    dissipated += losses.dissipated;
    if (losses.tears)
      notes_.push_back("bolt " + quoted(bolt.bolt().name) + " has torn at time " + std::to_string(next.time) +
                       " s");
  }
  energy_.now.plastic_dissipated += dissipated;
  energy_.now.numerical_dissipated += bolt_energy(blocks_, state_) - bolt_energy(blocks_, next) - dissipated -
                                      system_->bolt_forces(solution.straight).dot(motion);
}

void Stepper::book(const StepWork& work) {
  Energy& e = energy_.now;
  e.gravity += work.gravity;
  e.external += work.external;
  e.friction_dissipated += work.friction;
  e.damping_dissipated += work.damping;
  e.numerical_dissipated += work.scheme;
  e.pushed_out += work.pushed_out;
}

void Stepper::book_shift(const VectorXd& shift) {
  VectorXd weight = VectorXd::Zero(blocks_.n_unknowns()), loads = weight;
  blocks_.add_gravity(weight);
  blocks_.add_loads(state_, state_.time, loads);
  energy_.now.gravity -= weight.dot(shift);
  energy_.now.external += loads.dot(shift);
  energy_.now.numerical_dissipated += (weight + loads).dot(shift);
}

void Stepper::book_kinetic(double kinetic) {
  energy_.now.numerical_dissipated -= kinetic - energy_.now.kinetic;
  energy_.now.kinetic = kinetic;
}

void Stepper::measure_contacts(const BlockState& from, const VectorXd& d, const VectorXd& motion) {
  for (Contact& contact : trial_contacts_) {
    if (contact.normal == 0 && contact.shear == 0) continue;
    contact_builder_->start_from(from, contact);
    const GapAndSlip at_d =
        contact.motion.gap_and_slip_at(d, contact.history.lock, system_->rule().directions());
    contact.gap_change = contact.motion.change_along(at_d.by_gap, motion);
    contact.slip_change = contact.motion.change_along(at_d.by_slip, motion);
  }
}

void Stepper::assess(double dt, const Solution& solution, const BlockState& next) {
  const VectorXd velocity = is_static() ? solution.d / dt : next.velocity;
  const double before = equilibrium_.unbalanced;
  const Points& reactions = asleep_ ? asleep_->part_reactions : reactions_;
  equilibrium_ =
      has_motions()
          ? find_equilibrium(blocks_, sum_forces(blocks_, *system_, solution.straight, reactions),
                             trial_contacts_, velocity)
          : find_equilibrium(blocks_, *system_, solution.residual, trial_contacts_, reactions, velocity);
  for (int* b : {&equilibrium_.unbalanced_block, &equilibrium_.fastest_block})
    if (*b >= 0) *b = in_whole(*b);
  equilibrium_.unbalanced_before = before;
  warnings_.look(
      {.blocks = blocks_,
       .positions = next.position,
       .d = solution.d,
       .contacts = trial_contacts_,
       .dt = dt,
       .time = state_.time + dt,
       .has_velocities = !is_static(),
       .is_first = !begun_,
       .in_whole = asleep_ ? std::span<const int>(asleep_->part->blocks()) : std::span<const int>{}});
}

void Stepper::prepare_and_keep_momentum() {
  if (analysis_.preset == Preset::paper || analysis_.kinematics == Kinematics::corotational || is_static()) {
    blocks_.prepare(state_);
    return;
  }
  Points before(2, blocks_.n_blocks());
  for (int b = 0; b < blocks_.n_blocks(); ++b)
    before.col(b) = rigid_velocity(blocks_.block(b), state_.velocity).linear;
  blocks_.prepare(state_);
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (!blocks_.is_free(b)) continue;
    const Block& block = blocks_.block(b);
    const Vec2 lost = before.col(b) - rigid_velocity(block, state_.velocity).linear;
    state_.velocity.segment(block.unknowns().first, block.unknowns().count) += block.translations() * lost;
  }
}

void Stepper::record_reactions(const VectorXd& d, const Residual& residual) {
  Points& reactions = asleep_ ? asleep_->part_reactions : reactions_;
  reactions.setZero(2, state_.position.cols());
  for (const PrescribedDof& held : blocks_.prescribed_dofs())
    reactions(held.axis, held.vertex) += residual.force[held.unknown];
  for (const StepSystem::FixedPointSpring& spring : system_->fixed_point_springs()) {
    const FixedVertex& held = blocks_.fixed_vertices[spring.fixed_vertex];
    reactions(spring.axis, blocks_.block(held.block).vertices().first + held.vertex) -=
        system_->fixed_point_stiffness() * spring.form(d);
  }
  if (!asleep_) return;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (asleep_->part->is_resting(b)) continue;
    const Range &from = blocks_.block(b).points(), &to = asleep_->part->points_in_whole(b);
    reactions_.middleCols(to.first, to.count) =
        reactions.middleCols(from.first, from.count) + asleep_->reactions.middleCols(to.first, to.count);
  }
}

/// A contact that slides rises: the gap that counts as none grows with what of its slip is not its spring's.
/// What that lifts is paid for by what friction takes.
void Stepper::dilate(Contact& contact, double shear_before) {
  const JointStrength& joint = properties_.strength(contact.pair);
  ContactHistory& history = contact.history;
  const double most = joint.dilation * joint.dilation_slip, before = history.gap_offset;
  if (!contact.closed() || before >= most) return;
  const double elastic =
      contact.law.compliant ? (shear_before - history.shear) / contact.law.tangential_stiffness : 0;
  const double rise = std::min(joint.dilation * std::abs(contact.slip_change - elastic), most - before);
  history.gap_offset += rise;
  if (contact.law.compliant) {
    const double p = contact.law.normal_stiffness, normal = history.normal;
    history.normal += p * rise;
    energy_.now.friction_dissipated -= (history.normal + normal) / 2 * rise;
  } else {
    energy_.now.friction_dissipated -= contact.normal * rise;
    energy_.now.numerical_dissipated += contact.normal * rise;
  }
}

void Stepper::record_contacts() {
  counts_.contacts = asleep_ ? asleep_->n_closed : 0;
  for (Contact& contact : trial_contacts_) {
    ContactHistory& history = contact.history;
    contact.end_gap = contact.gap - history.gap_offset;
    const bool compliant = contact.law.compliant,
               hands_on = contact.closed() && (properties_.has_multipliers() || compliant);
    const double by_dashpot =
        contact.normal == 0 ? 0 : contact.damping * (contact.gap - contact.motion.start_gap());
    const double shear_before = history.shear;
    const ContactForce end = end_forces_of_joint(contact, system_->rule().mean_forces());
    history.normal = hands_on ? contact.normal + by_dashpot : 0;
    history.shear = hands_on ? contact.shear : 0;
    if (compliant && hands_on) {
      history.normal = end.normal;
      history.shear = end.shear;
    }
    if (is_slipping(history.state)) dilate(contact, shear_before);
    const bool slid = is_slipping(history.state) && !contact.law.frictionless() && !contact.law.ductile;
    if (slid || !contact.closed()) history.bonded = false;
    const bool had_strength = contact.law.cohesion > 0 || contact.law.tension > 0;
    if (contact.start_bonded && !history.bonded && had_strength) ++counts_.broken_bonds;
    if (!contact.closed()) {
      const double left = std::clamp(contact.gap, std::min(history.gap_offset, 0.0), 0.0);
      history.gap_offset = left < -contact.length_tolerance() ? left : 0;
      continue;
    }
    ++counts_.contacts;
    counts_.max_penetration = std::max(counts_.max_penetration, -contact.end_gap);
  }
  counts_.contacts_max = std::max(counts_.contacts_max, counts_.contacts);
}

}  // namespace ddacontact
