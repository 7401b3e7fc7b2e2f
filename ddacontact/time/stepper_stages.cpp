// Where a stepper begins and where it is among its stages, and going on from there.
#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/core/quoted.hpp>
#include <ddacontact/equations/bolt_law.hpp>
#include <ddacontact/time/driven_blocks.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/stepper.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

/// Installs a bolt; a bond that its pretension is too large for has slipped then.
void put_in(const Bolt& bolt, const BlockSystem& blocks, BlockState& state) {
  install(bolt, blocks, state);
  follow(bolt, VectorXd::Zero(bolt.n_segments()), bolt.numbers.of(state.bolts));
}

/// What contacts are solved to by central differences where nothing else is requested: a step's error is made
/// up for in the next, and the scheme's own is larger (doc/decisions.md).
constexpr double tolerance_of_explicit_steps = 1e-3;

/// Whether the pair names a vertex and an edge of these blocks, or rounded corners where they are rounded.
bool is_between(const BlockSystem& blocks, const VertexEdge& pair) {
  const auto has = [&](int b, int corner) {
    return b >= 0 && b < blocks.n_blocks() && corner >= 0 && corner < blocks.block(b).n_vertices();
  };
  return has(pair.vertex_block, pair.vertex) && has(pair.edge_block, pair.edge) &&
         (!pair.corner || blocks.has_rounded_corners());
}

/// Whether the same forces act under both on the same blocks in the same motion.
bool have_same_forces(const Stage& a, const Stage& b) {
  const auto &x = a.analysis, &y = b.analysis;
  return x.scheme == y.scheme && x.mode == y.mode && x.gravity == y.gravity && a.water == b.water &&
         x.damping == y.damping && a.joints.entries() == b.joints.entries();
}

/// How many contacts glue holds that these joints cannot hold in its place.
long count_beyond_strength(const std::vector<ContactRecord>& contacts, ContactProperties properties,
                           const JointTable& joints) {
  const ContactProperties glued = properties;
  properties.joints = joints;
  return std::ranges::count_if(contacts, [&](const ContactRecord& contact) {
    if (!glued.is_glued(contact)) return false;
    const JointLaw law = properties.law(contact);
    const bool bonded = contact.history.bonded;
    const double allowed = largest_unbalanced * std::hypot(contact.normal, contact.shear);
    return -contact.normal > (bonded ? law.tension : 0) + allowed ||
           std::abs(contact.shear) > shear_bound(law, contact.normal, bonded) + allowed;
  });
}

}  // namespace

Stepper::Stepper(BlockSystem blocks, BlockState initial, const ContactProperties& contacts,
                 std::vector<Stage> stages)
    : blocks_(std::move(blocks)),
      stages_(std::move(stages)),
      limits_(blocks_, stages_.front().analysis),
      properties_(contacts),
      state_(std::move(initial)),
      trial_(participants_, contacts_, analysis_, properties_, run_.counts),
      sleepers_(participants_, contacts_, properties_, limits_, trial_) {
  run_.reactions = Points::Zero(2, state_.position.cols());
  remove_later(stages_, blocks_);
  if (std::ranges::any_of(stages_, [](const Stage& stage) { return stage.water.any(); }))
    faces_ = divide_faces(blocks_);
  apply(stages_.front(), 0);
  blocks_.reshape(state_, true);
  for (const Bolt& bolt : blocks_.bolts)
    if (bolt.installed) put_in(bolt, blocks_, state_);
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    run_.convex.push_back(block.cell(0).basis == &polyfem::wachspress &&
                          !polyfem::find_non_convex_corner(block.reference().leftCols(block.n_vertices())));
  }
  trial_.detect_first(analysis_.time_step,
                      limits_.search_margin(blocks_, state_, {}, analysis_.time_step, 1));
  contacts_.assign(trial_.contacts().begin(), trial_.contacts().end());
  accepted_ = {substep_, run_.counts};
  sleepers_.accept();
  start_accounts();
}

void Stepper::apply(const Stage& stage, double start_time) {
  analysis_ = stage.analysis;
  limits_.set_analysis(analysis_);
  change_blocks(stage, start_time, faces_, blocks_);
  if (!stage.added.empty()) {
    blocks_.reshape(state_, true);
    state_.coordinates.resize(0);
  }
  trial_.forget_pairs(properties_);  // it knows those that were there, and the ground
  trial_.forget_islands();
  if (!trial_.has_system() || !stage.removed.empty() || !stage.added.empty() || !stage.bolts.empty())
    trial_.make_system();
  std::erase_if(contacts_, [&](const ContactRecord& contact) {
    return !blocks_.is_present(contact.pair.vertex_block) || !blocks_.is_present(contact.pair.edge_block);
  });
  properties_.joints = stage.joints;
  trial_.builder().set_joints(stage.joints);
  find_motions();
  stable_ = find_stable_step(blocks_, analysis_);
  substep_ = longest_substep();
  if (stable_ && stable_->n_decaying > 0)
    run_.notes.push_back("by the explicit scheme " + std::to_string(stable_->n_decaying) +
                         " slivers do not vibrate: their deformation decays");
  trial_.options().solve_to(properties_.tolerance || !stable_ ? properties_.tolerance
                                                              : tolerance_of_explicit_steps);
}

void Stepper::begin_contacts_of(const std::vector<int>& coming) {
  trial_.detect_first(analysis_.time_step, limits_.search_margin(blocks_, state_, {}, analysis_.time_step, 1),
                      coming);
  for (const Contact& contact : trial_.contacts())
    if (contact.closed() &&
        std::ranges::any_of(contact.pair.blocks(), [&](int b) { return std::ranges::count(coming, b) > 0; }))
      contacts_.push_back(contact);
  std::ranges::stable_sort(contacts_, {}, pair_of);
}

void Stepper::find_motions() {
  if (!has_motions())
    state_.coordinates.resize(0);
  else if (state_.coordinates.size() == 0)
    blocks_.find_coordinates(state_);
  for (int b = 0; has_motions() && b < blocks_.n_blocks(); ++b)
    if (!blocks_.block(b).shape() && !blocks_.is_unchanging(b))
      throw Error("block " + quoted(blocks_.names[b]) + " has no motions that half steps could carry on");
}

VectorXd Stepper::forces_of(const std::vector<int>& blocks) const {
  VectorXd forces = VectorXd::Zero(blocks_.n_unknowns());
  const auto is_one = [&](int b) { return std::ranges::count(blocks, b) > 0; };
  for (const ContactRecord& contact : contacts_)
    if (is_one(contact.pair.vertex_block) != is_one(contact.pair.edge_block))
      properties_.add_forces(blocks_, state_, contact, forces);
  for (int b : blocks) {
    const Range& u = blocks_.block(b).unknowns();
    u.of(forces).setZero();
  }
  return forces;
}

bool Stepper::enter_stage(int stage) {
  sleepers_.wake_all();
  if (const std::optional<Pair> overlap =
          find_overlap(blocks_, state_, stages_[stage].added, stages_[stage].removed)) {
    stop_reason_ = "block " + quoted(blocks_.names[(*overlap)[0]]) + " comes in where block " +
                   quoted(blocks_.names[(*overlap)[1]]) + " is";
    return false;
  }
  run_.stage_ends.push_back(stage_end());
  forget_ahead();
  if (const Stage& next = stages_[stage]; next.relax > 0)
    blocks_.fading = {forces_of(next.removed), state_.time,
                      state_.time + next.relax * next.analysis.time_step};
  const long n_beyond = count_beyond_strength(contacts_, properties_, stages_[stage].joints);
  apply(stages_[stage], state_.time);
  if (!is_static() && n_beyond > 0)
    run_.notes.push_back("at time " + std::to_string(state_.time) +
                         " s dynamic steps let go at once what glue held beyond the strength of the joints "
                         "(contacts: " +
                         std::to_string(n_beyond) +
                         "): blocks vibrate and may slip (put a static stage without glue before them)");
  progress_.stage = stage;
  progress_.steps = 0;
  progress_.came_to_rest = false;
  progress_.start_times.push_back(state_.time);
  if (!stages_[stage].added.empty()) begin_contacts_of(stages_[stage].added);
  detected_ = false;
  for (int b : stages_[stage].removed) {
    const Range& u = blocks_.block(b).unknowns();
    for (VectorXd* of_all : {&state_.velocity, &state_.carried}) of_all->segment(u.first, u.count).setZero();
  }
  for (int bolt : stages_[stage].bolts) put_in(blocks_.bolts[bolt], blocks_, state_);
  Energy& e = run_.energy.now;
  // What goes with the blocks that are taken out is work done on them, as what pretensions bring.
  const double kinetic = kinetic_energy(blocks_, state_.velocity),
               elastic = elastic_energy(blocks_, state_, contacts_, properties_);
  e.external += (kinetic - e.kinetic) + (elastic - e.elastic);
  e.kinetic = kinetic;
  e.elastic = elastic;
  const Stage &last = stages_[stage - 1], &next = stages_[stage];
  if (is_static() || !next.removed.empty() || !next.added.empty() || !next.bolts.empty() ||
      next.has_new_loads() || !have_same_forces(last, next)) {
    // Half of the impulse of the next step, or what accelerates it, would be of forces that act no more.
    state_.carried.setZero();
    state_.carried_dt = 0;
  }
  if (is_static()) {
    state_.velocity.setZero();
    e.numerical_dissipated += kinetic;
    e.kinetic = 0;
  }
  accepted_ = {substep_, run_.counts};
  sleepers_.accept();
  return true;
}

bool Stepper::is_at_rest() const {
  if (!begun_ || !run_.equilibrium.in_balance()) return false;
  return is_static() ||
         run_.equilibrium.meets({.kinetic = 1e-8, .displacement = 1e-6}, run_.energy.exchanged());
}

StageEnd Stepper::stage_end() const {
  return {.stage = progress_.stage,
          .steps = progress_.steps,
          .time = state_.time,
          .came_to_rest = progress_.came_to_rest,
          .at_rest = is_at_rest(),
          .exchanged = run_.energy.exchanged(),
          .equilibrium = run_.equilibrium};
}

void Stepper::leave_stage() {
  if (stages_[progress_.stage].reset_displacements) blocks_.count_displacements_from(state_);
}

void Stepper::start_accounts() {
  run_.energy = {};
  run_.energy.now.kinetic = kinetic_energy(blocks_, state_.velocity);
  run_.energy.now.elastic = elastic_energy(blocks_, state_, contacts_, properties_);
  run_.energy.start();
  run_.equilibrium = {};
  run_.stage_ends.clear();
  run_.warnings = RunWarnings(blocks_.n_blocks());
}

StepRecord Stepper::record() const {
  return {run_.counts.steps, begun_,     substep_,          progress_, state_,
          blocks_.fading,    contacts(), sleepers_.record()};
}

void Stepper::restore(StepRecord record) {
  if (record.progress.stage < progress_.stage)
    throw Error("the record is of stage " + std::to_string(record.progress.stage) +
                ", which is over (restore it to a new stepper)");
  const auto sizes = [](const BlockState& of) {
    return std::array{of.position.cols(), of.origin.cols(), of.rotation.size(),
                      of.velocity.size(), of.stress.cols(), std::ssize(of.bolts)};
  };
  const auto n_slept = std::ssize(record.sleeping.island);
  if (sizes(record.state) != sizes(state_) || (n_slept != 0 && n_slept != blocks_.n_blocks()) ||
      record.progress.stage >= static_cast<int>(stages_.size()) ||
      !std::ranges::all_of(record.contacts,
                           [&](const ContactRecord& contact) { return is_between(blocks_, contact.pair); }))
    throw Error("the record is of other blocks or stages");
  sleepers_.wake_all();
  while (progress_.stage < record.progress.stage) {
    const int stage = ++progress_.stage;
    apply(stages_[stage], record.progress.start_times[stage]);
  }
  blocks_.fading = std::move(record.fading);
  run_.counts.steps = record.steps;
  begun_ = record.begun;
  substep_ = record.substep;
  progress_ = record.progress;
  state_ = std::move(record.state);
  contacts_ = std::move(record.contacts);
  find_motions();
  blocks_.reshape(state_, true);
  forget_ahead();
  margin_scale_ = 1;
  accepted_ = {substep_, run_.counts};
  sleepers_.accept();
  start_accounts();
  if (record.sleeping.island.empty()) return;
  sleepers_.restore(record.sleeping);
}

RunRecord Stepper::run_record() const {
  const BlockState& zero = blocks_.displacement_zero();
  return {run_, record(), blocks_.end_time, zero.position, zero.origin};
}

void Stepper::restore(RunRecord record) {
  restore(std::move(record.step));
  run_ = record;
  accepted_.counts = run_.counts;
  blocks_.end_time = record.end_time;
  BlockState zero;
  zero.position = std::move(record.zero_position);
  zero.origin = std::move(record.zero_origin);
  blocks_.count_displacements_from(zero);
}

}  // namespace ddacontact
