#include <ddacontact/time/stepper.hpp>

#include <ddacontact/block/for_blocks.hpp>
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/contact/for_contacts.hpp>
#include <ddacontact/time/borne_blocks.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/half_steps.hpp>
#include <ddacontact/time/support_velocity.hpp>
#include <ddacontact/time/waves.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/out_of_memory.hpp>
#include <polyfem/core/stopwatch.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ddacontact {

namespace {

/// A substep shorter than this times time_step is not tried.
constexpr double shortest_substep = 1e-3;
/// From this times time_step on, a substep is accepted with unsettled stick and slip, and counted.
constexpr double tolerant_substep = 1e-2;
/// A block that moved further than its contacts were looked for has them looked for this much further.
constexpr double reach_growth = 4;
/// What a scene can do where no forces of contacts are found.
constexpr const char* cure_of_unsettled =
    " (glue the joint while blocks settle: joints = { NAME = { glued = true } } in a [[stage]]; or give it a "
    "smaller friction_angle)";
/// A step is solved again so often for contacts that closed fast without having been foreseen.
constexpr int most_impact_rounds = 4;

/// The length of a step without the round-off of the times that it lies between: what was made for the step
/// before serves again.
double without_round_off(double dt, double time_step, double time) {
  const double whole_part = time_step / std::round(time_step / dt);
  const double round_off = 4 * std::numeric_limits<double>::epsilon() * std::abs(time);
  return std::abs(dt - whole_part) <= round_off ? whole_part : dt;
}

std::string quoted(const std::string& name) {
  return "\"" + name + "\"";
}

std::vector<ContactForce> forces_of(const std::vector<Contact>& contacts) {
  std::vector<ContactForce> forces;
  forces.reserve(contacts.size());
  for (const Contact& contact : contacts) forces.push_back({contact.normal, contact.shear});
  return forces;
}

}  // namespace

/// While it lives a step is made.
class Stepper::PartInPlace {
 public:
  explicit PartInPlace(Stepper& stepper) : stepper_(stepper) {
    stepper_.in_step_ = true;
    stepper_.show_part();
  }
  ~PartInPlace() {
    stepper_.in_step_ = false;
    stepper_.show_whole();
  }
  PartInPlace(const PartInPlace&) = delete;
  PartInPlace& operator=(const PartInPlace&) = delete;

 private:
  Stepper& stepper_;
};

Stepper::Stepper(BlockSystem blocks, BlockState initial, const ContactProperties& contacts,
                 std::vector<Stage> stages)
    : blocks_(std::move(blocks)),
      stages_(std::move(stages)),
      limits_(blocks_, stages_.front().analysis),
      properties_(contacts),
      method_(contacts.method),
      staged_{.penetration_tolerance = contacts.penetration_tolerance},
      held_stiffness_(contacts.normal_stiffness),
      state_(std::move(initial)),
      reactions_(Points::Zero(2, state_.position.cols())),
      warnings_(blocks_.n_blocks()),
      sleeping_(blocks_.n_blocks()) {
  contact_builder_.emplace(blocks_, properties_);
  apply(stages_.front());
  substep_ = analysis_.time_step;
  blocks_.prepare(state_, true);
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    convex_.push_back(block.cell(0).basis == &polyfem::wachspress &&
                      !polyfem::find_non_convex_corner(block.reference().leftCols(block.n_vertices())));
  }
  const std::vector<Contact> first = contact_builder_->build_first(
      state_, predicted_motion(analysis_.time_step), limits_.reach(state_, {}, analysis_.time_step, 1));
  contacts_.assign(first.begin(), first.end());
  accepted_ = {substep_, counts_, {}};
  set_flight_acceleration();
  start_accounts();
}

bool Stepper::step() {
  const bool more_stages = progress_.stage + 1 < static_cast<int>(stages_.size());
  if (more_stages && (progress_.steps == analysis_.steps || progress_.came_to_rest))
    enter_stage(progress_.stage + 1);
  bool made = false;
  {
    const PartInPlace while_stepping(*this);
    made = carry_on();
  }
  if (!made) return false;
  const std::optional<RestCriterion>& until = stages_[progress_.stage].until;
  const bool comes_to_rest =
      !progress_.came_to_rest && until && equilibrium_.meets(*until, energy_.exchanged());
  if (comes_to_rest) progress_.came_to_rest = true;
  if (++progress_.steps == analysis_.steps || comes_to_rest) leave_stage();
  return true;
}

Stepper::Substep Stepper::next_substep(long steps_made) {
  const double end = progress_.start_time + static_cast<double>(steps_made + 1) * analysis_.time_step;
  const double remaining = end - state_.time;
  const double wanted = std::min(substep_, limits_.foreseen_step(state_, contacts_));
  const double shortest = shortest_substep * analysis_.time_step;
  const double pieces = std::max(1.0, std::ceil(remaining / std::max(wanted, shortest) - 1e-9));
  const double dt = without_round_off(remaining / pieces, analysis_.time_step, end);
  return {dt, end, pieces <= 1, dt * analysis_.cutting_factor < shortest};
}

bool Stepper::carry_on() {
  while (true) {
    const auto [dt, end, is_last, is_shortest] = next_substep(progress_.steps);
    Try result;
    try {
      result = try_step(dt);
      if (result == Try::accepted) {
        substep_ = std::min(analysis_.time_step, std::max(substep_, 2 * dt));
        if (is_last) {
          state_.time = end;
          ++counts_.steps;
        }
        accepted_ = {substep_, counts_, {}};
        look_ahead(next_substep(progress_.steps + is_last).dt);
        if (is_last) return true;
        if (is_interrupted()) return false;
        continue;
      }
    } catch (const std::bad_alloc& error) {
      if (accepting_) throw;
      forget_tries();
      stop_reason_ = dynamic_cast<const polyfem::OutOfMemory*>(&error)
                         ? error.what()
                         : "out of memory with " + std::to_string(blocks_.n_equations()) + " unknowns and " +
                               std::to_string(tried_.size()) + " contacts";
      return false;
    }
    ++counts_.rejected;
    if (is_interrupted()) return false;
    if (result == Try::woke_blocks) continue;
    if (result == Try::missed_contacts) {
      ++counts_.overlap_rejections;
      continue;
    }
    if (result == Try::outran_detection) {
      reach_scale_ *= reach_growth;
      detected_ = false;
      continue;
    }
    if (is_shortest) {
      stop_reason_ =
          rejection_ + ", even with a substep of " + std::to_string(dt / analysis_.time_step) + " time_step";
      return false;
    }
    substep_ = dt * analysis_.cutting_factor;
  }
}

void Stepper::look_ahead(double dt) {
  if (state_.carried_dt > 0) {
    try {
      ahead_ = Ahead{dt, find_solution(dt), counts_};
    } catch (const std::bad_alloc&) {  // the step itself will say so
      forget_tries();
    }
    counts_ = accepted_.counts;
    if (ahead_ && (ahead_->solution.objection.empty() || ahead_->solution.friction_unsettled)) {
      const Solution& solution = ahead_->solution;
      VectorXd after = blocks_.straight_motion(solution.d) / dt;
      if (solution.impact.changes()) after -= solution.impact.jump;
      const bool by_forces = !solution.impact.changes() && analysis_.damping.mass == 0;
      state_.velocity = velocity_between(blocks_, state_, after, dt,
                                         by_forces ? &solution.residual.external : nullptr);
      book_kinetic(kinetic_energy(blocks_, state_.velocity));
    } else {
      accepted_.counts.unknown_velocities = ++counts_.unknown_velocities;
      if (ahead_) ++ahead_->counts.unknown_velocities;
    }
  }
  energy_.close_step(tolerated_work_);
}

void Stepper::book_kinetic(double kinetic) {
  energy_.now.numerical_dissipated -= kinetic - energy_.now.kinetic;
  energy_.now.kinetic = kinetic;
}

bool Stepper::is_interrupted() {
  if (!interrupted_ || !interrupted_()) return false;
  forget_tries();
  stop_reason_ = "interrupted";
  return true;
}

void Stepper::forget_tries() {
  substep_ = accepted_.substep;
  counts_ = accepted_.counts;
  if (accepted_.sleeping) {
    sleeping_ = Sleeping(*accepted_.sleeping);
    regroup(&accepted_.sleeping->around);
  }
  blocks_.prepare(state_);
  forget_ahead();
  reach_scale_ = 1;
}

void Stepper::forget_ahead() {
  ahead_.reset();
  detected_ = false;
}

Stepper::Solution Stepper::find_solution(double dt) {
  wake_changing(dt);
  if (!detected_) detect(dt);
  return solve_with_corners(dt);
}

Stepper::Try Stepper::try_step(double dt) {
  Solution solution;
  if (ahead_ && ahead_->dt == dt) {
    solution = std::move(ahead_->solution);
    counts_ = ahead_->counts;
    ahead_.reset();
  } else {
    ahead_.reset();
    solution = find_solution(dt);
  }

  const polyfem::Stopwatch watch(times_.update);
  if (wake_hit(solution)) return Try::woke_blocks;
  rejection_ = solution.objection;
  const bool cut_enough = dt * analysis_.cutting_factor < tolerant_substep * analysis_.time_step;
  if (!rejection_.empty() && !(solution.friction_unsettled && cut_enough)) return Try::rejected;

  bool outran = false;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (!blocks_.is_movable(b)) continue;
    const Block& block = blocks_.block(b);
    double furthest = 0;
    for (int v = 0; v < block.n_vertices(); ++v)
      furthest = std::max(furthest, block.vertex_map(v)(solution.d).norm());
    if (furthest > limits_.largest_displacement()) {
      rejection_ = "block " + quoted(blocks_.names[b]) +
                   " moves further in one step than max_displacement_ratio allows";
      return Try::rejected;
    }
    if (furthest > reach_[b]) {
      rejection_ =
          "block " + quoted(blocks_.names[b]) + " moves further in one step than contacts are looked for";
      if (reach_[b] >= limits_.largest_reach(b)) return Try::rejected;
      outran = true;
    }
  }
  if (outran) return Try::outran_detection;

  BlockState next = solution.impact.changes() ? solution.impact.start : state_;
  if (!advance(dt, solution, next)) return Try::rejected;
  // Which corner meets which edge is chosen before the motion is known: where that was wrong it shows here.
  if (analysis_.preset != Preset::paper && contact_builder_->find_entered(state_, next, tried_)) {
    restart_contacts();
    contact_builder_->add_entered(state_, tried_);
    keep_start();
    return Try::missed_contacts;
  }
  if (solution.friction_unsettled) {
    ++counts_.unconverged;
    last_unsettled_ = rejection_ + ", at time " + std::to_string(next.time) + " s";
  }
  accept(dt, solution, std::move(next));
  return Try::accepted;
}

void Stepper::detect(double dt) {
  const polyfem::Stopwatch watch(times_.detection);
  look_around(dt);
  contact_builder_->keep_pairs(analysis_.skip.skin);
  if (begun_)
    contact_builder_->build(state_, predicted_motion(dt), reach_, contacts_, tried_,
                            state_.time > progress_.start_time);
  else
    tried_ = contact_builder_->build_first(state_, predicted_motion(dt), reach_);
  keep_start();
  detected_ = true;
}

void Stepper::keep_start() {
  for_contacts(tried_.size(), [&](std::size_t c) {
    tried_[c].start_state = tried_[c].history.state;
    tried_[c].start_bonded = tried_[c].history.bonded;
  });
  has_tried_ = false;
}

void Stepper::restart_contacts() {
  if (!has_tried_) return;
  for_contacts(tried_.size(), [&](std::size_t c) { contact_builder_->restart(tried_[c]); });
  has_tried_ = false;
}

std::vector<Contact> Stepper::contacts_to_begin_with() {
  const PartInPlace while_looking(*this);
  forget_ahead();
  detect(analysis_.time_step);
  detected_ = false;
  return tried_;
}

Stepper::Solution Stepper::solve(double dt) {
  const StepRule rule = step_rule(analysis_, dt, state_.carried_dt);
  const bool has_impacts =
      method_ != ContactMethod::classic && !is_static() &&
      std::ranges::any_of(tried_, [&](const Contact& contact) {
        return restitution_of(contact_builder_->properties(), contact.pair, rule).has_value();
      });
  if (!has_impacts) return solve_with(dt, {}, nullptr);
  std::vector<char> also;
  Solution solution;
  for (int round = 0; round < most_impact_rounds; ++round) {
    StepImpact impact;
    {
      const polyfem::Stopwatch watch(times_.solver);
      if (round > 0) solution.forces = forces_of(tried_);
      restart_contacts();
      impact = foresee_impact(blocks_, state_, contact_builder_->properties(), tried_, rule,
                              state_.going_on(), dt, also);
    }
    solution = solve_with(dt, std::move(impact), round > 0 ? &solution : nullptr);
    if (!solution.objection.empty() || !find_unforeseen(dt, solution, also)) break;
  }
  return solution;
}

bool Stepper::find_unforeseen(double dt, const Solution& solution, std::vector<char>& also) const {
  const std::vector<char> before = also;
  also.resize(tried_.size(), 0);
  for (std::size_t c = 0; c < tried_.size(); ++c) {
    const Contact& start = tried_[c];
    if (start.start_state != ContactState::open || !start.closed() || solution.impact.hit[c]) continue;
    if (!restitution_of(contact_builder_->properties(), start.pair, system_->rule())) continue;
    const double rate = start.motion.change_along(start.first_gap().gradient, state_.going_on());
    if (-rate > least_approach(blocks_, start, dt)) also[c] = 1;
  }
  return also != before && std::find(also.begin(), also.end(), 1) != also.end();
}

Stepper::Solution Stepper::solve_with(double dt, StepImpact impact, const Solution* nearby) {
  const BlockState& from = impact.changes() ? impact.start : state_;
  const StepStart start{.rule = step_rule(analysis_, dt, state_.carried_dt),
                        .dt = dt,
                        .velocity = is_static() ? VectorXd::Zero(from.velocity.size()) : from.going_on(),
                        .acceleration = from.carried};
  {
    const polyfem::Stopwatch watch(times_.assembly);
    if (impact.changes()) blocks_.prepare(from);
    system_->set_step(from, start, held_stiffness_);
    system_->problem().keep_factor(analysis_.skip.unchanged_factor);
  }
  const polyfem::Stopwatch watch(times_.solver);
  restart_contacts();
  has_tried_ = true;
  for (Contact& contact : tried_) {
    contact.damping = contact_builder_->dashpot(contact.pair) / dt;
    if (impact.changes()) contact_builder_->start_from(from, contact);
  }
  Solution solution;
  const polyfem::Cholesky& cholesky = system_->problem().cholesky();
  const int solves = cholesky.n_solves(), factorizations = cholesky.n_factorizations(),
            analyses = cholesky.n_analyses();
  const polyfem::CholeskySeconds seconds = cholesky.seconds();
  if (method_ == ContactMethod::classic)
    solve_by_open_close(solution);
  else
    solve_by_stages(start, nearby, solution);
  if (impact.changes()) {
    for (Contact& contact : tried_) contact_builder_->start_from(state_, contact);
    blocks_.prepare(state_);
  }
  solution.impact = std::move(impact);
  counts_.linear_solves += cholesky.n_solves() - solves;
  counts_.factorizations += cholesky.n_factorizations() - factorizations;
  times_.analyses += cholesky.n_analyses() - analyses;
  times_.analysis += cholesky.seconds().analysis - seconds.analysis;
  times_.factorization += cholesky.seconds().factorization - seconds.factorization;
  times_.solution += cholesky.seconds().solution - seconds.solution;
  return solution;
}

void Stepper::solve_by_open_close(Solution& solution) {
  OpenCloseReport report = iterate_open_close(*system_, open_close_, tried_, solution.d);
  counts_.open_close_iterations += report.iterations;
  solution.residual = std::move(report.residual);
  switch (report.status) {
    case OpenCloseStatus::settled:
      return;
    case OpenCloseStatus::friction_unsettled:
      solution.friction_unsettled = true;
      solution.objection = "stick and slip did not settle" + between(report.disagreeing);
      return;
    case OpenCloseStatus::unsettled:
      solution.objection =
          "open and closed contacts did not settle" + between(report.disagreeing) + cure_of_unsettled;
      return;
    case OpenCloseStatus::not_positive_definite:
      solution.objection = "the equations are not positive definite";
      return;
    case OpenCloseStatus::not_finite:
      solution.objection = "the solution is not finite";
  }
}

void Stepper::solve_by_stages(const StepStart& start, const Solution* nearby, Solution& solution) {
  staged_.local = !is_static() && std::all_of(tried_.begin(), tried_.end(), [&](const Contact& contact) {
    return carries_waves(blocks_, contact, system_->dt());
  });
  staged_.skip = analysis_.skip;
  staged_.directions = start.rule.directions();
  staged_.lets_gaps_be = !is_static();
  solution.d = solution.start = system_->free_path();
  staged_.again = staged_.local && nearby;
  if (staged_.again) {
    solution.d += nearby->d - nearby->start;
    for_contacts(tried_.size(), [&](std::size_t c) {
      tried_[c].normal = nearby->forces[c].normal;
      tried_[c].shear = nearby->forces[c].shear;
    });
  }
  if (!is_static() && !staged_.local) start_borne_blocks(blocks_, tried_, start, solution.d);
  const bool apart = analysis_.skip.islands && analysis_.preset != Preset::paper && !is_static() &&
                     islands_.divide(blocks_, tried_);
  StagedReport report = apart ? islands_.solve(blocks_, state_, start, *system_, staged_, tried_, solution.d)
                              : solve_staged(*system_, staged_, tried_, solution.d);
  if (apart) {
    const IslandsApart::Work& work = islands_.last_work();
    counts_.linear_solves += work.n_solves;
    counts_.factorizations += work.n_factorizations;
    times_.analyses += work.n_analyses;
    times_.analysis += work.seconds.analysis;
    times_.factorization += work.seconds.factorization;
    times_.solution += work.seconds.solution;
  }
  counts_.open_close_iterations += report.iterations;
  counts_.interior_paths += report.interior_paths;
  counts_.augmentations += report.augmentations;
  counts_.sweeps += report.sweeps;
  counts_.solutions_without_factor += report.tangent.without_factor;
  counts_.solutions_with_stale_factor += report.tangent.with_stale_factor;
  counts_.krylov_iterations += report.tangent.iterations;
  counts_.solver_fallbacks += report.tangent.fallbacks;
  solution.residual = std::move(report.residual);
  switch (report.status) {
    case StagedStatus::settled:
      counts_.broken_bonds += report.broken_bonds;
      return;
    case StagedStatus::unsettled:
      solution.objection =
          "contact forces did not come into balance" + between(report.worst_contact) + cure_of_unsettled;
      return;
    case StagedStatus::penetrating:
      solution.objection = "penetration did not fall below its tolerance" + between(report.worst_contact);
      return;
    case StagedStatus::not_positive_definite:
      solution.objection = "the equations are not positive definite";
      return;
    case StagedStatus::not_finite:
      solution.objection = "the solution is not finite";
  }
}

std::string Stepper::between(int contact) const {
  if (contact < 0) return "";
  const VertexEdge& pair = tried_[contact].pair;
  return ", last between blocks " + quoted(blocks_.names[pair.vertex_block]) + " and " +
         quoted(blocks_.names[pair.edge_block]);
}

bool Stepper::check_concave(int b, const BlockState& next) {
  const Range& v = blocks_.block(b).vertices();
  if (polyfem::find_defect(next.position.middleCols(v.first, v.count))) {
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
  blocks_.end_step(d, solution.residual.external, next);
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
  const StepRule& rule = system_->rule();
  next.carried_dt = rule.has_half_steps() ? dt : 0;
  if (is_static()) {  // after a static step blocks are at rest
    next.velocity.setZero();
    next.carried.setZero();
    return true;
  }
  for (const HeldUnknown& held : blocks_.held_unknowns()) {
    // Where the trapezoidal rule goes on with this velocity d - dt v0 is a contact's force: a mean over the step
    // would be half a step late, and make it twice as large as the support's acceleration does.
    const bool of_both_sides = rule.mean_forces() && held.motion.kind == TimeFunction::Kind::history;
    (rule.has_half_steps() ? next.carried : next.velocity)[held.unknown] =
        of_both_sides ? support_velocity(held, next.time, dt, blocks_.end_time) : d[held.unknown] / dt;
  }
  if (rule.has_half_steps()) next.velocity = next.carried;
  return true;
}

void Stepper::accept(double dt, const Solution& solution, BlockState next) {
  accepting_ = true;
  record_reactions(solution.d, solution.residual);
  assess(dt, solution, next.velocity);
  VectorXd motion = blocks_.straight_motion(solution.d);
  if (solution.impact.changes()) motion += solution.impact.shift;
  if (system_->rule().has_half_steps()) account_impacts(motion);
  account_step(blocks_, *system_, {dt, solution.d, motion, solution.residual, tried_, properties_},
               energy_.now);
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
  contacts_.assign(tried_.begin(), tried_.end());
  state_ = std::move(next);
  prepare_and_keep_momentum();
  energy_.now.kinetic = kinetic_energy(blocks_, state_.velocity);
  energy_.now.elastic = elastic_energy(blocks_, state_, contacts_, properties_, held_stiffness_);
  if (asleep_) energy_.now.elastic += asleep_->elastic_outside;
  const bool some_fell_asleep = fall_asleep(dt);
  tolerated_work_ = 0;
  for (const Contact& contact : tried_)
    tolerated_work_ += std::max(contact.normal, 0.0) * staged_.penetration_tolerance * contact.size;
  ++counts_.substeps;
  counts_.max_residual = std::max(counts_.max_residual, solution.residual.own);
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

void Stepper::account_impacts(const VectorXd& motion) {
  const double dt = system_->dt(), impulse_time = system_->rule().impulse_time * dt;
  for (Contact& contact : tried_) {
    if (contact.normal == 0) continue;
    const GapAndSlip rates = contact.motion.rates_at(contact.motion.places(), contact.history.lock);
    contact.gap_change = contact.motion.change_along(rates.by_gap, motion);
    contact.slip_change = contact.motion.change_along(rates.by_slip, motion);
    const double before = contact.motion.change_along(rates.by_gap, state_.going_on()),
                 by_impulse = -contact.normal * impulse_time * (before + contact.gap_change / dt) / 2;
    energy_.now.damping_dissipated += by_impulse;
    energy_.now.numerical_dissipated -= by_impulse;
  }
}

void Stepper::assess(double dt, const Solution& solution, const VectorXd& end_velocity) {
  const VectorXd velocity = is_static() ? solution.d / dt : end_velocity;
  const double before = equilibrium_.unbalanced;
  equilibrium_ = find_equilibrium(blocks_, *system_, solution.residual, tried_,
                                  asleep_ ? asleep_->part_reactions : reactions_, velocity);
  for (int* b : {&equilibrium_.unbalanced_block, &equilibrium_.fastest_block})
    if (*b >= 0) *b = in_whole(*b);
  equilibrium_.unbalanced_before = before;
  warnings_.look(
      {.blocks = blocks_,
       .d = solution.d,
       .contacts = tried_,
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
  for (const HeldUnknown& held : blocks_.held_unknowns())
    reactions(held.axis, held.vertex) += residual.force[held.unknown];
  for (const StepSystem::HeldSpring& spring : system_->held_springs()) {
    const HeldVertex& held = blocks_.held_vertices[spring.held_vertex];
    reactions(spring.axis, blocks_.block(held.block).vertices().first + held.vertex) -=
        system_->held_stiffness() * spring.form(d);
  }
  if (!asleep_) return;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (asleep_->part->is_resting(b)) continue;
    const Range &from = blocks_.block(b).places(), &to = asleep_->part->places_in_whole(b);
    reactions_.middleCols(to.first, to.count) =
        reactions.middleCols(from.first, from.count) + asleep_->reactions.middleCols(to.first, to.count);
  }
}

void Stepper::record_contacts() {
  counts_.contacts = asleep_ ? asleep_->n_closed : 0;
  for (Contact& contact : tried_) {
    ContactHistory& history = contact.history;
    contact.end_gap = contact.gap - history.gap_offset;
    const bool hands_on = contact.closed() && properties_.has_multipliers();
    const double by_dashpot =
        contact.normal == 0 ? 0 : contact.damping * (contact.gap - contact.motion.start_gap());
    history.normal = hands_on ? contact.normal + by_dashpot : 0;
    history.shear = hands_on ? contact.shear : 0;
    const bool slid = is_slipping(contact.history.state) && !contact.law.frictionless();
    if (slid || !contact.closed()) history.bonded = false;
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
