#include <ddacontact/time/trial_step.hpp>

#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/contact/dashpots.hpp>
#include <ddacontact/contact/seams.hpp>
#include <ddacontact/core/for_all.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/time/waves.hpp>
#include <polyfem/core/stopwatch.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <map>
#include <utility>

namespace ddacontact {

namespace {

/// Why a solution is rejected, and what a scene can do about it; empty: it is not.
///
/// \param[in] between  names two blocks
/// \param[in] driven   whether supports move one of them
std::string why_rejected(SolutionStatus status, const std::string& between, bool driven) {
  static constexpr const char* of_unsettled =
      " (smaller time_step or friction_angle; in a settling [[stage]]: joints = { NAME = { glued = true } })";
  static const std::map<SolutionStatus, std::array<const char*, 2>> whys{
      {SolutionStatus::friction_unsettled, {"stick and slip did not settle", ""}},
      {SolutionStatus::states_unsettled, {"open and closed contacts did not settle", of_unsettled}},
      {SolutionStatus::forces_unsettled, {"contact forces did not come into balance", of_unsettled}},
      {SolutionStatus::penetrating,
       {"penetration did not fall below its tolerance",
        " (smaller time_step; contact.corner_rounding = 0.003; glued affine blocks: other block_model)"}},
      {SolutionStatus::not_positive_definite, {"the equations are not positive definite", ""}},
      {SolutionStatus::not_finite, {"the solution is not finite", ""}}};
  if (status == SolutionStatus::settled) return "";
  return whys.at(status)[0] + between +
         (driven ? " (do supports in motion leave room?)" : whys.at(status)[1]);
}

/// Whether a vertex leaves an edge round the corner at its end: this corner bears on an edge beside the vertex, and
/// the predicted motion takes the vertex past it. The vertex is in front of its own edge until then, and beyond it
/// afterwards.
/// \param[in] along  where the vertex is over its edge in the end, from the start of that, m
bool leaves_round_corner(const BlockSystem& blocks, const Contact& contact, double along,
                         std::span<const Contact> of_pair) {
  const VertexEdge& leaving = contact.pair;
  const auto is_end = [&](int vertex, int edge, int block) {
    return vertex == edge || vertex == (edge + 1) % blocks.block(block).n_vertices();
  };
  return std::ranges::any_of(of_pair, [&](const Contact& corner) {
    const auto& [block, vertex, other, edge, at_corner] = corner.pair;
    const bool is_past = vertex == leaving.edge ? along < 0 : along > contact.edge_length();
    return corner.closed() && is_past && block == leaving.edge_block && is_end(leaving.vertex, edge, other) &&
           is_end(vertex, leaving.edge, block);
  });
}

/// Finds which contacts meet their edges: the vertex is over the edge, or beyond its end by no more than the
/// lip, where the predicted motion takes it past the line; if it does not, at the start. Of blocks that meet
/// something else in the step no motion tells which edges they miss, but for those that they leave round a corner.
/// \param[in] starts  the contacts where the step begins, not where jumps of velocities let it begin: between
///                    that place and the end the way is taken as straight
void find_meeting(const BlockSystem& blocks, const VectorXd& predicted, double lip, const StepImpact& impact,
                  const std::vector<Contact>& starts, std::vector<Contact>& contacts) {
  const bool moves = impact.changes() || !predicted.isZero(0);
  std::vector<char> touches(blocks.n_blocks(), 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Contact& contact = contacts[c];
    const bool hit = impact.changes() && impact.hit[c];
    const double outside = starts[c].first_gap().constant - contact.history.gap_offset,
                 slip = starts[c].first_slip().constant;
    double end_gap = outside, end_slip = slip;
    if (moves && !contact.closed()) {
      const GapAndSlip end =
          contact.motion.gap_and_slip_at(predicted, contact.history.lock, Directions::of_end);
      end_gap = end.gap - contact.history.gap_offset;
      end_slip = end.slip;
    }
    const bool passes = outside > 0 && end_gap < 0;
    const double passing = passes ? slip + outside / (outside - end_gap) * (end_slip - slip) : slip;
    contact.leaves =
        moves && !contact.closed() &&
        leaves_round_corner(blocks, contact, contact.history.lock * contact.edge_length() + end_slip,
                            of_same_pair(contact.pair, contacts));
    contact.meets = hit || (!contact.leaves && contact.is_on_edge(passing, passes ? lip * contact.size
                                                                                  : contact.end_tolerance()));
    if (contact.closed() || (contact.meets && (hit || end_gap < 0)))
      for (int b : contact.pair.blocks()) touches[b] = blocks.is_movable(b);
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    Contact& contact = contacts[c];
    if (touches[contact.pair.vertex_block] || touches[contact.pair.edge_block])
      contact.meets = contact.meets || (!contact.leaves && starts[c].starts_on_edge());
  }
}

}  // namespace

TrialStep::TrialStep(const Participants& participants, const std::vector<ContactRecord>& last,
                     const AnalysisOptions& analysis, const ContactProperties& properties, StepCounts& counts)
    : participants_(participants),
      last_(last),
      analysis_(analysis),
      counts_(counts),
      options_(properties.tolerance, properties.penetration_tolerance) {
  forget_pairs(properties);
}

void TrialStep::make_system() {
  system_.emplace(blocks());
  forget_islands();
}

VectorXd TrialStep::predicted_motion(const BlockState& from, double dt) const {
  const bool at_rest = is_static() || analysis_.preset == Preset::paper;
  VectorXd d = at_rest ? VectorXd::Zero(from.velocity.size()) : VectorXd(dt * from.going_on());
  if (analysis_.preset == Preset::paper || blocks().prescribed_dofs().empty()) return d;
  const VectorXd prescribed = blocks().prescribed(from, from.time + dt);
  for (const PrescribedDof& held : blocks().prescribed_dofs()) d[held.unknown] = prescribed[held.unknown];
  return d;
}

void TrialStep::detect(double dt, const std::vector<double>& margin, bool doubts) {
  doubts_ = doubts;
  builder_->keep_pairs(analysis_.skip.skin);
  builder_->build(state(), predicted_motion(state(), dt), margin, last_, contacts_);
  keep_start();
}

void TrialStep::detect_first(double dt, const std::vector<double>& margin, const std::vector<int>& coming) {
  builder_->keep_pairs(analysis_.skip.skin);
  contacts_ = builder_->build_first(state(), predicted_motion(state(), dt), margin, coming);
  keep_start();
}

bool TrialStep::take_missed(const BlockState& next) {
  if (!builder_->find_missed(state(), next, contacts_)) return false;
  restart();
  builder_->add_missed(state(), contacts_);
  keep_start();
  return true;
}

void TrialStep::keep_start() {
  share_friction_at_seams(blocks(), state(), builder_->properties(), contacts_);
  for_all(contacts_.size(), [&](std::size_t c) {
    contacts_[c].start_state = contacts_[c].history.state;
    contacts_[c].start_bonded = contacts_[c].history.bonded;
  });
  solved_ = false;
}

void TrialStep::restart() {
  if (!solved_) return;
  for_all(contacts_.size(), [&](std::size_t c) { builder_->restart(contacts_[c]); });
  solved_ = false;
}

TrialSolution TrialStep::solve_with_impacts(double dt, const TrialSolution* warm_start) {
  const StepRule rule = this->rule(dt);
  const bool has_impacts =
      !is_classic() && !is_static() && std::ranges::any_of(contacts_, [&](const Contact& contact) {
        return restitution_of(builder_->properties(), contact.pair, rule).has_value();
      });
  if (!has_impacts) return solve_with(dt, {}, warm_start);
  std::vector<char> forced;
  TrialSolution solution;
  for (int round = 0; round < most_rounds; ++round) {
    StepImpact impact;
    {
      const polyfem::Stopwatch watch(times_.solver);
      restart();
      impact = predict_impact({blocks(), state(), builder_->properties(), contacts_, rule, dt}, forced);
    }
    solution = solve_with(dt, std::move(impact), round > 0 ? &solution : warm_start);
    if (!solution.rejection.empty() || !find_unpredicted(dt, solution, forced)) break;
  }
  return solution;
}

bool TrialStep::find_unpredicted(double dt, const TrialSolution& solution, std::vector<char>& forced) const {
  const std::vector<char> before = forced;
  forced.resize(contacts_.size(), 0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const Contact& start = contacts_[c];
    if (start.start_state != ContactState::open || !start.closed() || solution.impact.hit[c]) continue;
    if (!restitution_of(builder_->properties(), start.pair, rule(dt))) continue;
    const double rate = start.motion.change_along(start.first_gap().gradient, state().going_on());
    if (-rate > least_approach(blocks(), start, dt)) forced[c] = 1;
  }
  return forced != before && std::find(forced.begin(), forced.end(), 1) != forced.end();
}

TrialSolution TrialStep::solve_with(double dt, StepImpact impact, const TrialSolution* warm_start) {
  const BlockState& from = impact.changes() ? impact.start : state();
  const StepStart start = step_from(analysis_, from, dt);
  {
    const polyfem::Stopwatch watch(times_.assembly);
    system_->set_step(from, start, builder_->properties().normal_stiffness);
    system_->problem().keep_factor(analysis_.skip.unchanged_factor);
  }
  const polyfem::Stopwatch watch(times_.solver);
  restart();
  solved_ = true;
  set_dashpots(blocks(), builder_->properties(), dt, contacts_);
  const std::vector<Contact> unshifted = impact.changes() ? contacts_ : std::vector<Contact>();
  if (impact.changes()) builder_->start_from(from, contacts_);
  if (!is_classic()) {
    VectorXd predicted = predicted_motion(from, dt);
    find_meeting(blocks(), system_->displacement(predicted), builder_->properties().lip, impact,
                 impact.changes() ? unshifted : contacts_, contacts_);
  }
  TrialSolution solution;
  const polyfem::Cholesky& cholesky = system_->problem().cholesky();
  const polyfem::CholeskyWork before = cholesky.work();
  take(is_classic() ? iterate_open_close(*system_, contacts_, solution.d)
                    : solve_by_contact_solver(start, from, warm_start, solution),
       solution);
  solution.straight = solution.d;
  solution.d = system_->displacement(solution.straight);
  if (impact.changes()) builder_->start_from(state(), contacts_);
  solution.impact = std::move(impact);
  add(cholesky.work().since(before));
  return solution;
}

void TrialStep::add(const polyfem::CholeskyWork& work) {
  counts_.linear_solves += work.n_solves;
  counts_.factorizations += work.n_factorizations;
  times_.analyses += work.n_analyses;
  times_.analysis += work.analysis;
  times_.factorization += work.factorization;
  times_.solution += work.solution;
}

ContactSolverReport TrialStep::solve_by_contact_solver(const StepStart& start, const BlockState& from,
                                                       const TrialSolution* warm_start,
                                                       TrialSolution& solution) {
  options_.local =
      !is_static() && (start.rule.is_explicit() ||
                       std::all_of(contacts_.begin(), contacts_.end(), [&](const Contact& contact) {
                         return carries_waves(blocks(), contact, system_->dt());
                       }));
  options_.skip = analysis_.skip;
  options_.directions = start.rule.directions();
  options_.is_static = is_static();
  solution.d = solution.start = system_->free_path();
  options_.warm_start = warm_start;
  if (warm_start) solution.d += warm_start->straight - warm_start->start;
  const bool apart = analysis_.skip.islands && analysis_.preset != Preset::paper && !is_static() &&
                     islands_.divide(blocks(), contacts_);
  if (!apart) return solve_contacts(*system_, options_, contacts_, solution.d);
  ContactSolverReport report = islands_.solve(from, start, *system_, options_, contacts_, solution.d);
  add(islands_.last_work());
  return report;
}

void TrialStep::take(ContactSolverReport report, TrialSolution& solution) {
  counts_.contact_iterations += report.iterations;
  counts_.interior_point_solves += report.interior_point_solves;
  counts_.augmentations += report.augmentations;
  counts_.sweeps += report.sweeps;
  counts_.interior_solutions += report.interior_solutions;
  counts_.solver_fallbacks += report.sweep_fallbacks;
  solution.tolerance = report.tolerance;
  solution.residual = std::move(report.residual);
  solution.friction_unsettled = report.status == SolutionStatus::friction_unsettled;
  solution.rejection =
      why_rejected(report.status, between(report.worst_contact), is_driven(report.worst_contact));
}

std::string TrialStep::between(int contact) const {
  if (contact < 0) return "";
  const VertexEdge& pair = contacts_[contact].pair;
  return ", last between blocks " + quoted(blocks().names[pair.vertex_block]) + " and " +
         quoted(blocks().names[pair.edge_block]);
}

bool TrialStep::is_driven(int contact) const {
  return contact >= 0 && std::ranges::any_of(blocks().prescribed_dofs(), [&](const PrescribedDof& held) {
           return system_->prescribed()[held.unknown] != 0 &&
                  std::ranges::count(contacts_[contact].pair.blocks(), blocks().block_of_point(held.vertex)) >
                      0;
         });
}

}  // namespace ddacontact
