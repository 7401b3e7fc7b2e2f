#include <ddacontact/time/sleeping_blocks.hpp>

#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/time/energy_accounts.hpp>

#include <algorithm>
#include <iterator>

namespace ddacontact {

namespace {

bool is_steady(const TimeFunction& function) {
  return function.kind == TimeFunction::Kind::constant && function.rise == 0;
}

/// Whether a vector of which there are means over spans changes from one time to another, by more than
/// round-off.
bool varies(const auto& mean, double from, double to) {
  const Vec2 before = mean(from);
  const double round_off = few_ulps * before.norm();
  return (mean({from, to}) - before).norm() > round_off || (mean(to) - before).norm() > round_off;
}

bool varies(const TimeFunction& function, double from, double to, double end_time) {
  return !is_steady(function) &&
         varies([&](const TimeSpan& s) { return function.mean(s, end_time); }, from, to);
}

/// Of records that begin and end with a jump too.
bool ground_varies(const BlockSystem& blocks, double from, double to) {
  return varies([&](const TimeSpan& span) { return blocks.ground_acceleration(span); }, from, to);
}

void mark_blocks_on_bolts(const BlockSystem& blocks, std::vector<char>& marks) {
  for (const Bolt& bolt : blocks.bolts)
    for (const MaterialPoint& node : bolt.nodes)
      if (node.block >= 0 && acts(bolt, blocks)) marks[node.block] = 1;
}

Box box_of(const BlockSystem& blocks, const BlockState& state, int b, double margin) {
  return shifted(bounding_box(blocks.block(b).outline(state), margin), state.origin.col(b));
}

/// Its vertices, and what is inside a mesh, whose vertices may be held, by the mean.
bool is_slow(const Block& block, const VectorXd& velocity, double speed) {
  const Range& u = block.unknowns();
  return block.furthest_vertex(velocity) <= speed &&
         2 * block.kinetic_energy(u.of(velocity)) <= block.mass_total() * speed * speed;
}

}  // namespace

SleepingBlocks::SleepingBlocks(Participants& participants, std::vector<ContactRecord>& contacts,
                               const ContactProperties& properties, MotionLimits& limits, TrialStep& trial)
    : whole_(participants),
      participants_(participants),
      contacts_(contacts),
      properties_(properties),
      limits_(limits),
      trial_(trial),
      sleeping_(participants.blocks->n_blocks()) {}

SleepingBlocks::WhileStepping::WhileStepping(SleepingBlocks& sleepers) : sleepers_(sleepers) {
  sleepers_.in_step_ = true;
  sleepers_.pass_to_part();
}

SleepingBlocks::WhileStepping::~WhileStepping() {
  sleepers_.in_step_ = false;
  sleepers_.participants_ = sleepers_.whole_;
}

SleepRecord SleepingBlocks::record() const {
  return {sleeping_.islands(), sleeping_.rested(), asleep_ ? asleep_->around : std::vector<Box>{}};
}

void SleepingBlocks::restore(const SleepRecord& record) {
  sleeping_ = Sleeping(record);
  if (asleep_ || sleeping_.n_asleep() > 0) regroup(&record.around);
}

void SleepingBlocks::discard() {
  if (before_) restore(*before_);
}

bool SleepingBlocks::may_sleep() const {
  const AnalysisOptions& analysis = trial_.analysis();
  return analysis.skip.sleep && analysis.preset != Preset::paper &&
         properties_.method == ContactMethod::staged && analysis.mode != Mode::statics;
}

std::vector<ContactRecord> SleepingBlocks::contacts_in_whole() const {
  std::vector<ContactRecord> contacts = contacts_;
  for (ContactRecord& contact : contacts)
    for (int* b : {&contact.pair.vertex_block, &contact.pair.edge_block}) *b = asleep_->part->blocks()[*b];
  return contacts;
}

const std::vector<ContactRecord>& SleepingBlocks::contacts() const {
  if (!asleep_) return contacts_;
  if (!all_contacts_known_) {
    all_contacts_.clear();
    std::ranges::merge(contacts_in_whole(), asleep_->contacts, std::back_inserter(all_contacts_), {}, pair_of,
                       pair_of);
    all_contacts_known_ = true;
  }
  return all_contacts_;
}

std::vector<char> SleepingBlocks::find_restless(double dt) const {
  std::vector<char> restless(blocks().n_blocks(), 0);
  const double to = state().time, from = to - dt, end_time = blocks().end_time;
  blocks().for_load_functions([&](int b, const TimeFunction& function) {
    if (varies(function, from, to, end_time)) restless[b] = 1;
  });
  for (int b = 0; blocks().fading.part_left(from) > 0 && b < blocks().n_blocks(); ++b)
    if (!blocks().block(b).unknowns().of(blocks().fading.forces).isZero(0)) restless[b] = 1;
  if (ground_varies(blocks(), from, to)) restless.assign(restless.size(), 1);
  for (const PrescribedDof& held : blocks().prescribed_dofs())
    if (varies(held.motion, from, to, end_time)) restless[blocks().block_of_point(held.vertex)] = 1;
  for (const FixedVertex& held : blocks().fixed_vertices) restless[held.block] = 1;
  mark_blocks_on_bolts(blocks(), restless);
  // Contacts that open, or go from sticking to sliding and back as those at their bound do by round-off, show
  // in speeds; those that close under more than makes such a speed bear something new.
  const auto force_of_rest = [&](int b) {
    return blocks().block(b).mass_total() * rest_speed(blocks(), b, dt, trial_.analysis().damping) / dt;
  };
  for (const Contact& contact : trial_.contacts()) {
    const auto [p, q] = contact.pair.blocks();
    const bool has_closed = contact.start_state == ContactState::open && contact.closed();
    for (const auto& [b, other] : {Pair{p, q}, Pair{q, p}})
      if ((has_closed && contact.normal > force_of_rest(b)) ||
          (contact.closed() && !blocks().is_movable(other) && !blocks().is_unchanging(other)))
        restless[b] = 1;  // what is driven takes part in every step, and so do its contacts
  }
  return restless;
}

bool SleepingBlocks::fall_asleep(double dt) {
  if (!may_sleep()) return false;
  const std::vector<char> restless = find_restless(dt);
  std::vector<int> awake;
  for (int b = 0; b < blocks().n_blocks(); ++b) {
    if (!blocks().is_movable(b)) continue;
    awake.push_back(in_whole(b));
    sleeping_.note(in_whole(b),
                   !restless[b] && is_slow(blocks().block(b), state().going_on(),
                                           rest_speed(blocks(), b, dt, trial_.analysis().damping)));
  }
  std::vector<Pair> touching;
  for (const Contact& contact : trial_.contacts())
    if (contact.closed() && blocks().is_movable(contact.pair.vertex_block) &&
        blocks().is_movable(contact.pair.edge_block))
      touching.push_back({in_whole(contact.pair.vertex_block), in_whole(contact.pair.edge_block)});
  const std::vector<int> falling = sleeping_.put_to_sleep(awake, touching);
  for (int b : falling) {
    const Range& u = blocks().block(asleep_ ? asleep_->part->number_of(b) : b).unknowns();
    u.of(state().velocity).setZero();
    u.of(state().carried).setZero();
  }
  return !falling.empty();
}

void SleepingBlocks::remember() {
  if (!before_) before_ = record();
}

bool SleepingBlocks::wake(int b) {
  if (!sleeping_.is_asleep(b)) return false;
  remember();
  return sleeping_.wake(b);
}

bool SleepingBlocks::wake_changing(double dt) {
  if (!asleep_) return false;
  bool woken = false;
  const double now = state().time, then = now + dt;
  if (ground_varies(blocks(), now, then)) {
    remember();
    sleeping_.wake_all();
    woken = true;
  }
  for (const auto& [block, function] : asleep_->watched)
    if (varies(*function, now, then, blocks().end_time)) woken = wake(block) || woken;
  if (woken) regroup();
  return woken;
}

const std::vector<double>& SleepingBlocks::look_around(double dt, double margin_scale) {
  while (true) {
    const std::vector<double>& margin = limits_.search_margin(blocks(), state(), contacts_, dt, margin_scale);
    if (!asleep_) return margin;
    bool woken = false, covered = true;
    std::vector<char> driven(blocks().n_blocks(), 0);
    for (const PrescribedDof& held : blocks().prescribed_dofs())
      if (varies(held.motion, state().time, state().time + dt, blocks().end_time))
        driven[blocks().block_of_point(held.vertex)] = 1;
    std::size_t k = 0;
    for (int b = 0; b < blocks().n_blocks(); ++b) {
      if (blocks().is_unchanging(b)) continue;
      const Box box = box_of(blocks(), state(), b, margin[b]);
      if (blocks().is_movable(b)) covered = lies_in(box, asleep_->around[k++]) && covered;
      const bool comes = driven[b] || !blocks().is_movable(b);
      if (comes && margin[b] > length_round_off * blocks().block(b).size())
        for (std::size_t other = 0; other < asleep_->boxes.size(); ++other)
          if (touch(box, asleep_->boxes[other])) woken = wake(static_cast<int>(other)) || woken;
    }
    if (woken) {
      regroup();
    } else if (!covered) {
      remember();
      contacts_ = contacts_in_whole();
      pass_to_whole();
      form_part(nullptr);
    } else {
      return margin;
    }
  }
}

bool SleepingBlocks::wake_hit(const TrialSolution& solution) {
  if (!asleep_) return false;
  bool woken = false;
  for (std::size_t c = 0; c < trial_.contacts().size(); ++c) {
    const Contact& contact = trial_.contacts()[c];
    if (!asleep_->part->is_resting(contact.pair.vertex_block) &&
        !asleep_->part->is_resting(contact.pair.edge_block))
      continue;
    const bool hit = !solution.impact.hit.empty() && solution.impact.hit[c];
    const bool inside = contact.gap - contact.history.gap_offset < -contact.length_tolerance() &&
                        contact.is_on_edge(contact.end_slip);
    if (!contact.closed() && !hit && !inside) continue;
    for (int b : contact.pair.blocks()) woken = wake(in_whole(b)) || woken;
  }
  if (woken) regroup();
  return woken;
}

void SleepingBlocks::wake_all() {
  sleeping_.wake_all();
  if (asleep_) regroup();
}

void SleepingBlocks::regroup(const std::vector<Box>* around) {
  contacts_ = std::vector(contacts());
  pass_to_whole();
  asleep_.reset();
  all_contacts_known_ = false;
  if (sleeping_.n_asleep() > 0) {
    survey();
    form_part(around);
  } else {
    trial_.forget_pairs(properties_);
    trial_.make_system();
  }
}

void SleepingBlocks::survey() {
  const BlockSystem& whole = *whole_.blocks;
  Asleep& asleep = asleep_.emplace(Asleep{});
  const auto takes_part = [&](int b) { return !whole.is_unchanging(b) && !sleeping_.is_asleep(b); };
  const auto has_part = [&](const ContactRecord& contact) {
    return takes_part(contact.pair.vertex_block) || takes_part(contact.pair.edge_block);
  };
  std::ranges::copy_if(contacts_, std::back_inserter(asleep.contacts), std::not_fn(has_part));
  std::erase_if(contacts_, std::not_fn(has_part));
  asleep.elastic_of_contacts = spring_energy(asleep.contacts, properties_);
  for (int b = 0; b < whole.n_blocks(); ++b) {
    asleep.boxes.push_back(box_of(whole, *whole_.state, b, 0));
    asleep.elastic.push_back(
        takes_part(b) || !whole.is_present(b) ? 0 : whole.block(b).elastic_energy(*whole_.state));
  }
  VectorXd forces = VectorXd::Zero(whole.n_unknowns());
  for (const ContactRecord& contact : asleep.contacts) {
    if (!contact.closed()) continue;
    ++asleep.n_closed;
    properties_.add_forces(whole, *whole_.state, contact, forces);
  }
  asleep.reactions = Points::Zero(2, whole_.state->position.cols());
  const auto watch = [&](int block, const TimeFunction& function) {
    if (sleeping_.is_asleep(block) && !is_steady(function)) asleep.watched.push_back({block, &function});
  };
  for (const PrescribedDof& held : whole.prescribed_dofs()) {
    const int b = whole.block_of_point(held.vertex);
    if (!whole.is_movable(b)) asleep.reactions(held.axis, held.vertex) -= forces[held.unknown];
    watch(b, held.motion);
  }
  whole.for_load_functions(watch);
}

void SleepingBlocks::form_part(const std::vector<Box>* around) {
  Asleep& asleep = *asleep_;
  const BlockSystem& whole = *whole_.blocks;
  const int n_blocks = whole.n_blocks();
  std::vector<char> resting(n_blocks, 0), takes_part(n_blocks, 0);
  std::vector<Box> boxes;
  for (int b = 0; b < n_blocks; ++b) {
    resting[b] = sleeping_.is_asleep(b);
    takes_part[b] = whole.is_present(b) && !resting[b] && !whole.is_unchanging(b);
    // Neighbours are looked for as far as its size, and its reach, around a block.
    if (takes_part[b] && whole.is_movable(b) && !around)
      boxes.push_back(box_of(whole, *whole_.state, b,
                             whole.block(b).size() + limits_.largest_search_margin(whole.block(b))));
  }
  asleep.around = around ? *around : boxes;

  // Those that rest near them: first within the box of all of them, then by pairs.
  boxes = asleep.around;
  std::vector<int> near;
  if (!boxes.empty()) {
    Box all = boxes.front();
    for (const Box& box : boxes) all = joined(all, box);
    for (int b = 0; b < n_blocks; ++b)
      if (whole.is_present(b) && !takes_part[b] && touch(all, asleep.boxes[b])) {
        near.push_back(b);
        boxes.push_back(asleep.boxes[b]);
      }
    const int n_around = static_cast<int>(asleep.around.size());
    for (const auto& [a, b] : overlapping_pairs(boxes))
      if (a < n_around && b >= n_around) takes_part[near[b - n_around]] = 1;
  }
  mark_blocks_on_bolts(whole, takes_part);  // they are awake, or held
  std::vector<int> part;
  asleep.elastic_outside = asleep.elastic_of_contacts;
  for (int b = 0; b < n_blocks; ++b) {
    if (takes_part[b])
      part.push_back(b);
    else
      asleep.elastic_outside += asleep.elastic[b];
  }
  asleep.part.emplace(whole, std::move(part), resting);

  std::erase_if(contacts_, [&](ContactRecord& contact) {
    int &a = contact.pair.vertex_block, &b = contact.pair.edge_block;
    a = asleep.part->number_of(a);
    b = asleep.part->number_of(b);
    return a < 0 || b < 0;
  });
  pass_to_part();
  ContactProperties properties = properties_;
  properties.materials.clear();
  properties.edge_joints.clear();
  for (int b : asleep.part->blocks()) {
    properties.materials.push_back(properties_.materials[b]);
    if (!properties_.edge_joints.empty()) properties.edge_joints.push_back(properties_.edge_joints[b]);
  }
  trial_.forget_pairs(properties);
  trial_.make_system();
  if (!in_step_) pass_to_whole();
}

void SleepingBlocks::spread_reactions(const Points& of_step, Points& of_whole) const {
  const std::vector<int>& points = asleep_->part->points();
  for (int p = 0; p < static_cast<int>(points.size()); ++p)
    if (!asleep_->part->is_resting(blocks().block_of_point(p)))
      of_whole.col(points[p]) = of_step.col(p) + asleep_->reactions.col(points[p]);
}

void SleepingBlocks::pass_to_part() {
  if (!asleep_ || !whole_takes_part()) return;
  asleep_->part->read(*whole_.blocks, *whole_.state);
  participants_ = {&asleep_->part->system(), &asleep_->part->state()};
}

void SleepingBlocks::write() {
  if (!whole_takes_part()) asleep_->part->write(*whole_.blocks, *whole_.state);
}

void SleepingBlocks::pass_to_whole() {
  write();
  participants_ = whole_;
}

}  // namespace ddacontact
