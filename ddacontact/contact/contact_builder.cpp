#include <ddacontact/contact/contact_builder.hpp>

#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/contact/contacts_by_pair.hpp>
#include <ddacontact/contact/kinematics.hpp>
#include <ddacontact/core/for_all.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/half_width.hpp>
#include <ddacontact/detection/rounded_phase.hpp>
#include <ddacontact/detection/separation.hpp>
#include <ddacontact/detection/touching_edges.hpp>
#include <polyfem/core/parallel.hpp>

#include <algorithm>
#include <functional>
#include <utility>

namespace ddacontact {

/// Pairs of blocks are looked for so many search margins further than they have to be.
constexpr double skin_of_margin = 4;
/// What one thread works on at a time.
constexpr Index of_range = 256;

/// Whether a corner is no further behind the line that it meets than joints are flush.
static bool is_flush(const ContactProperties& properties, const Contact& contact) {
  return properties.lip < inf && contact.gap > -properties.lip * contact.size && !contact.law.compliant;
}

ContactBuilder::ContactBuilder(const BlockSystem& blocks, ContactProperties properties)
    : blocks_(blocks), properties_(std::move(properties)) {
  std::vector<int> n_vertices;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    half_width_.push_back(half_width(block.reference().leftCols(block.n_vertices())));
    n_vertices.push_back(block.n_vertices());
  }
  outlines_ = OutlineTable(n_vertices);
}

double ContactBuilder::pair_size(int a, int b) const {
  if (!blocks_.is_movable(a)) return blocks_.block(b).size();
  if (!blocks_.is_movable(b)) return blocks_.block(a).size();
  return std::min(blocks_.block(a).size(), blocks_.block(b).size());
}

double ContactBuilder::lip(int a, int b, bool touch) const {
  return properties_.lip * pair_size(a, b) +
         (touch || closure_.empty() ? 0 : std::max(closure_[a], closure_[b]));
}

void ContactBuilder::find_pairs(const BlockState& state) {
  const Index n = blocks_.n_blocks();
  boxes_.resize(n);
  margins_.resize(keeps_pairs_ ? n : 0);
  for_all(n, [&](int b) {
    outlines_.set(b, blocks_.block(b).outline(state));
    double reach = search_margin_[b];
    if (blocks_.has_rounded_corners()) reach = std::max(reach, blocks_.rounded(b).radius);
    boxes_[b] = shifted(widened(outlines_[b].box, reach), state.origin.col(b));
    if (keeps_pairs_) margins_[b] = skin_of_margin * search_margin_[b];
  });
  if (!std::exchange(knows_covered_, true)) find_covered(state);
  nearby_.find(boxes_, margins_, pairs_);
  if (blocks_.has_rounded_corners()) find_clearances(state);
  const bool any_compliant = properties_.joints.any(&JointStrength::is_compliant);
  std::erase_if(pairs_, [&](const Pair& pair) {
    const auto [a, b] = pair;
    // Between wholly held blocks a joint with a stiffness alone has forces that one can tell.
    const bool bears = any_compliant ? !blocks_.is_unchanging(a) || !blocks_.is_unchanging(b)
                                     : blocks_.is_movable(a) || blocks_.is_movable(b);
    return !bears || !blocks_.is_present(a) || !blocks_.is_present(b);
  });
}

void ContactBuilder::find_clearances(const BlockState& state) {
  clearances_.assign(static_cast<std::size_t>(state.position.cols()), {});
  for (const Pair& pair : pairs_)
    for (const auto& [b, other] : {pair, Pair{pair[1], pair[0]}}) {
      const Box near = shifted(widened(outlines_[other].box, blocks_.rounded(b).radius),
                               state.origin.col(other) - state.origin.col(b));
      const Range& vertices = blocks_.block(b).vertices();
      for (int v = vertices.first; v < vertices.end(); ++v)
        if (const Vec2 x = state.position.col(v); blocks_.is_present(other) && touch({x, x}, near))
          clearances_[v].add(other, distance_to_outline(x, blocks_.outline_from(state, other, b)));
    }
}

double ContactBuilder::met_radius(int b, int v, int by) const {
  if (!blocks_.has_rounded_corners() || !blocks_.rounded(b).corners[v].is_arc) return 0;
  const CornerClearance& clearance = clearances_[blocks_.block(b).vertices().first + v];
  return std::min(blocks_.corner_radius(b, by), clearance.without(by));
}

void ContactBuilder::find_covered(const BlockState& state) {
  if (properties_.lip == inf) return;
  std::vector<int> held;
  std::vector<Box> boxes;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (!blocks_.is_held(b)) continue;
    held.push_back(b);
    boxes.push_back(
        shifted(widened(outlines_[b].box, properties_.lip * blocks_.block(b).size()), state.origin.col(b)));
  }
  for (const Pair& pair : overlapping_pairs(boxes))
    for (const auto& [p, q] : {pair, Pair{pair[1], pair[0]}}) {
      const int b = held[p], c = held[q];
      const double near = properties_.lip * std::min(blocks_.block(b).size(), blocks_.block(c).size());
      const Points own = blocks_.outline_from(state, b, b), other = blocks_.outline_from(state, c, b);
      for (const TouchingEdges& part : touching_edges(own, other, near)) {
        const int e = static_cast<int>(part.edge), f = static_cast<int>(part.other), after = next(f, other);
        const Vec2 edge = along(own, e), start = own.col(e), end = own.col(next(e, own));
        if (edge.dot(along(other, f)) > 0) continue;
        const Vec2 past_start = other.col(after) - start, past_end = other.col(f) - end;
        covered_[b].push_back({b, e, part.from * edge.norm(), part.to * edge.norm(),
                               past_start.norm() > near ? past_start : along(other, after),
                               past_end.norm() > near ? past_end : -along(other, previous(f, other))});
      }
    }
}

std::span<const CoveredPart> ContactBuilder::covered_of(const Pair& pair) const {
  for (int b : pair)
    if (const auto found = covered_.find(b); found != covered_.end()) return found->second;
  return {};
}

void ContactBuilder::find_contacts_of(const Pair& pair, const BlockState& state, const VectorXd& motion,
                                      std::span<const ContactRecord> previous, FoundContacts& found) const {
  thread_local Points shifted_b, moved_a, moved_b;
  thread_local std::vector<EarlierContact> earlier;
  const auto [a, b] = pair;
  const double size = pair_size(a, b);
  PairLimits limits{.search_margin = search_margin_[a] + search_margin_[b],
                    .max_depth = std::min(half_width_[a], half_width_[b]),
                    .coincidence = coincidence * size,
                    .lip = lip(a, b, std::ranges::any_of(previous, &ContactRecord::closed))};
  limits.largest_turn = std::min(limits.largest_turn, limits.search_margin / size);
  earlier.clear();
  const bool any_compliant = properties_.joints.any(&JointStrength::is_compliant),
             any_shifted = properties_.joints.any(&JointStrength::shifts);
  for (const ContactRecord& contact : previous) {
    double offset = contact.lasts() ? contact.history.gap_offset : 0;
    // A joint that has closed by its stiffness is flush.
    if (any_compliant && contact.closed() && properties_.is_compliant(contact)) offset += contact.end_gap;
    // So is one that was crushed, or is to rise to where dilation lifts it.
    if (any_shifted && contact.closed() && properties_.strength(contact.pair).shifts())
      offset = std::min(offset, gap(positions_of(blocks_, state, contact.pair)));
    earlier.push_back({contact.pair, offset, contact.closed()});
  }
  const auto move = [&](int block, const PointsRef& outline, Points& moved) {
    if (moved.cols() < outline.cols()) moved.resize(2, outline.cols());
    for (Index v = 0; v < outline.cols(); ++v)
      moved.col(v) = outline.col(v) + blocks_.block(block).vertex_map(static_cast<int>(v))(motion);
  };
  // The origin of either block serves, as long as it is always that of the smaller index.
  const Range &of_a = blocks_.block(a).vertices(), &of_b = blocks_.block(b).vertices();
  if (shifted_b.cols() < of_b.count) shifted_b.resize(2, of_b.count);
  const Vec2 shift = state.origin.col(b) - state.origin.col(a);
  shifted_b.leftCols(of_b.count) = of_b.columns_of(state.position).colwise() + shift;
  OutlineSides sides_b = outlines_[b];
  sides_b.box = shifted(sides_b.box, shift);
  const auto start_a = of_a.columns_of(state.position);
  const auto start_b = shifted_b.leftCols(of_b.count);
  // What begins with an overlap is flush, and by a margin: both depths are found with round-off.
  if (begins_ && touch(widened(outlines_[a].box, -limits.lip), sides_b.box))
    limits.lip = std::max(limits.lip, -2 * separation(start_a, start_b));
  move(a, start_a, moved_a);
  move(b, start_b, moved_b);
  const std::size_t first = found.contacts.size();
  Outline one{a, start_a, moved_a.leftCols(of_a.count)}, other{b, start_b, moved_b.leftCols(of_b.count)};
  one.sides = outlines_[a];
  other.sides = sides_b;
  if (!blocks_.has_rounded_corners()) {
    find_contacts(one, other, limits, earlier, covered_of(pair), found);
  } else {
    thread_local std::vector<double> met_a, met_b;
    met_a.clear();
    met_b.clear();
    for (int v = 0; v < of_a.count; ++v) met_a.push_back(met_radius(a, v, b));
    for (int v = 0; v < of_b.count; ++v) met_b.push_back(met_radius(b, v, a));
    const RoundedPolygon round_a{one, blocks_.rounded(a), blocks_.corner_radius(a, b), met_a},
        round_b{other, blocks_.rounded(b), blocks_.corner_radius(b, a), met_b};
    // Of two corners at one place the first one stays.
    const bool b_first = round_b.rounded.radius < round_a.rounded.radius;
    find_rounded_contacts(b_first ? round_b : round_a, b_first ? round_a : round_b, limits, earlier, found);
  }
  if (any_compliant || blocks_.has_rounded_corners())
    leave_one_a_place(state, previous, found.contacts, first);
  leave_out_idle(pair, state, previous, found.contacts, first);
}

void ContactBuilder::leave_out_idle(const Pair& pair, const BlockState& state,
                                    std::span<const ContactRecord> previous, std::vector<VertexEdge>& found,
                                    std::size_t first) const {
  const bool held = !blocks_.is_free(pair[0]) && !blocks_.is_free(pair[1]),
             stiff = properties_.joints.any(&JointStrength::is_compliant) && !blocks_.has_rounded_corners();
  if (!held && !stiff) return;
  const auto of_pair = found.begin() + static_cast<std::ptrdiff_t>(first);
  const std::vector<VertexEdge> all(of_pair, found.end());
  const auto is_idle = [&](const VertexEdge& of) {
    const bool compliant = properties_.strength(of).is_compliant();
    // Where all is held a rigid contact has no force that one could tell. A corner that is yet to come over
    // an edge has no part of the length of a joint with a stiffness.
    return (held && !compliant && !can_change(state, of, previous)) ||
           (stiff && compliant && length_of(state, of, bearing(all)).total() == 0);
  };
  found.erase(std::remove_if(of_pair, found.end(), is_idle), found.end());
}

std::size_t ContactBuilder::detect(const BlockState& state, const VectorXd& motion,
                                   const std::vector<double>& search_margin,
                                   const std::vector<ContactRecord>& previous) {
  search_margin_ = search_margin;
  const double rise = properties_.joints.largest_rise();
  for (double& margin : search_margin_) margin += rise / 2;
  closure_.clear();
  if (properties_.joints.any(&JointStrength::is_compliant)) {
    closure_.resize(search_margin_.size());
    for (const ContactRecord& contact : previous)
      if (contact.closed() && properties_.is_compliant(contact))
        for (const int b : contact.pair.blocks())
          closure_[b] = std::max(closure_[b], -(contact.end_gap + contact.history.gap_offset));
  }
  find_pairs(state);
  const Index n = static_cast<Index>(pairs_.size());
  found_in_.resize((n + of_range - 1) / of_range);
  const auto check_pairs = [&](Index begin, Index end) {
    FoundContacts& found = found_in_[begin / of_range];
    found.contacts.clear();
    found.choices.clear();
    for (Index p = begin; p < end; ++p)
      find_contacts_of(pairs_[p], state, motion, of_pair(pairs_[p], previous), found);
  };
  polyfem::for_ranges(n, of_range, std::ref(check_pairs));
  choices_.clear();
  first_found_.assign(1, 0);
  for (const auto& [contacts, choices] : found_in_) {
    choices_.insert(choices_.end(), choices.begin(), choices.end());
    first_found_.push_back(first_found_.back() + contacts.size());
  }
  return first_found_.back();
}

Contact ContactBuilder::make_contact(const BlockState& state, const VertexEdge& pair,
                                     std::span<const VertexEdge> found, double normal) const {
  Contact contact;
  contact.pair = pair;
  const JointStrength& joint = properties_.strength(pair);
  if (joint.is_compliant() || joint.crushes() || !properties_.edge_joints.empty())
    set_length(state, found, contact);
  contact.history.normal = normal;
  const auto met = [&](int v) { return met_radius(pair.edge_block, v, pair.vertex_block); };
  contact.motion =
      motion_of(blocks_, state, pair, properties_.inset(contact), pair.corner ? met(pair.edge) : 0);
  contact.gap = contact.first_gap().constant;
  const VertexEdgePositions positions = contact.motion.slip_positions();
  contact.history.lock = edge_fraction(positions.i, positions.j, positions.k);
  const PointsRef outline = blocks_.block(pair.edge_block).outline(state);
  const auto sides = outlines_[pair.edge_block].sides;
  const auto straight = [&](int v, bool after) {
    if (sides[v].corner == Corner::straight) return straight_length(outline, pair.edge, after);
    return met(v) > 0 ? -blocks_.rounded(pair.edge_block).cut(v, sides[v].length, met(v)) : 0;
  };
  contact.straight_before = straight(pair.edge, false);
  contact.straight_after = straight(next(pair.edge, outline), true);
  if (pair.corner) contact.straight_before = contact.straight_after = inf;
  contact.size = pair_size(pair.vertex_block, pair.edge_block);
  contact.law = properties_.law(contact);
  // A corner that passes a step goes on with the gap that it has.
  if (is_flush(properties_, contact)) contact.history.gap_offset = std::min(contact.gap, 0.0);
  return contact;
}

ContactBuilder::Kinship ContactBuilder::kinship(const BlockState& state, const VertexEdge& old,
                                                const VertexEdge& pair) const {
  if (old == pair) return Kinship::same;
  const auto edge_outline = blocks_.block(pair.edge_block).outline(state);
  if (old.vertex_block == pair.vertex_block && old.vertex == pair.vertex && !old.corner && !pair.corner &&
      (are_collinear(edge_outline, old.edge, pair.edge) || are_collinear(edge_outline, pair.edge, old.edge)))
    return Kinship::collinear;
  const double size = pair_size(pair.vertex_block, pair.edge_block);
  return exchange_vertices(blocks_, state, near_corner * size, old, pair) ? Kinship::exchanged
                                                                          : Kinship::none;
}

const ContactRecord* ContactBuilder::find_predecessor(const BlockState& state, const VertexEdge& pair,
                                                      std::span<const VertexEdge> found,
                                                      std::span<const ContactRecord> previous) const {
  const ContactRecord* predecessor = nullptr;
  Kinship nearest = Kinship::none;
  for (const ContactRecord& old : previous) {
    const auto order = [&](const VertexEdge& of) { return std::pair(kinship(state, old.pair, of), &of); };
    const auto of_pair = order(pair);
    const auto comes_first = [&](const VertexEdge& other) { return order(other) < of_pair; };
    if (!old.lasts() || of_pair.first >= nearest || std::ranges::any_of(found, comes_first)) continue;
    predecessor = &old;
    nearest = of_pair.first;
  }
  return predecessor;
}

Contact ContactBuilder::carry_over(const BlockState& state, const VertexEdge& pair,
                                   std::span<const VertexEdge> found,
                                   std::span<const ContactRecord> previous) const {
  const ContactRecord* old = find_predecessor(state, pair, found, previous);
  Contact contact = make_contact(state, pair, found, old ? old->history.normal : 0);
  const double fraction = contact.history.lock;
  if (old && !old->closed()) {
    contact.history.gap_offset = old->history.gap_offset;
  } else if (old) {
    const double length = contact.history.length;
    contact.history = old->history;
    contact.since_asked = old->since_asked;
    const bool slides = is_slipping(old->history.state),
               shares_anew = properties_.is_compliant(*old) && slides && length > 0;
    if (shares_anew)  // what a joint's springs bear is a stress: it stays where neighbours take over a part
      for (double* force : {&contact.history.normal, &contact.history.shear})
        *force *= length / old->history.length;
    if (shares_anew ||
        (old->pair != pair && old->history.length > 0 &&
         (old->history.length_beyond != 0 || properties_.joint_of(old->pair) != properties_.joint_of(pair))))
      set_length(state, found, contact);
    else if (slides)
      set_length_beyond(state, contact);
    contact.law = properties_.law(contact);
    // Slip keeps its sign: the edges run the same way, or they are antiparallel, and so are the roles of
    // their blocks. Of a rounded corner another point touches now.
    if (old->pair != pair || contact.motion.rounding)
      contact.history.lock = fraction - old->end_slip / contact.edge_length();
    if (is_slipping(contact.history.state)) contact.history.lock = fraction;
    if (old->pair != pair && is_flush(properties_, contact))
      contact.history.gap_offset =
          std::min(std::max(contact.history.gap_offset, 0.0), contact.gap - old->end_gap);
  }
  if (!contact.closed() && contact.gap - contact.history.gap_offset < -contact.length_tolerance() &&
      contact.starts_on_edge()) {
    contact.history.state = contact.law.frictionless() ? ContactState::slip_forward : ContactState::stick;
    if (contact.law.compliant)
      contact.history.normal = contact.law.normal_stiffness * (contact.history.gap_offset - contact.gap);
  }
  if (properties_.is_glued(contact)) glue(contact);
  if (!contact.law.compliant) leave_out_friction(contact);
  return contact;
}

void ContactBuilder::restart(Contact& contact) const {
  contact.history.state = contact.start_state;
  contact.history.bonded = contact.start_bonded;
  if (!contact.law.compliant) {
    contact.law.normal_stiffness = properties_.normal_stiffness;
    contact.law.tangential_stiffness = properties_.tangential_stiffness;
  }
  contact.end_gap = contact.end_slip = 0;
  contact.was_closed = contact.meets = contact.leaves = false;
  contact.gap = contact.first_gap().constant;
}

void ContactBuilder::start_from(const BlockState& state, std::vector<Contact>& contacts) const {
  for (Contact& contact : contacts) contact.motion.start_from(positions_of(blocks_, state, contact.pair));
}

void ContactBuilder::build(const BlockState& state, const VectorXd& motion,
                           const std::vector<double>& search_margin,
                           const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts) {
  contacts.resize(detect(state, motion, search_margin, previous));
  const auto carry_on_range = [&](Index begin, Index /*end*/) {
    std::size_t c = first_found_[begin];
    for (std::span<const VertexEdge> rest = found_in_[begin].contacts; !rest.empty();) {
      const Pair pair = block_pair(rest.front());
      const auto others = std::ranges::find_if(rest, [&](const auto& of) { return block_pair(of) != pair; });
      const auto of_blocks = rest.first(others - rest.begin());
      const std::span<const ContactRecord> before = of_pair(pair, previous);
      for (const VertexEdge& entry : of_blocks) contacts[c++] = carry_over(state, entry, of_blocks, before);
      rest = rest.subspan(of_blocks.size());
    }
  };
  polyfem::for_ranges(static_cast<Index>(found_in_.size()), 1, std::ref(carry_on_range));
}

}  // namespace ddacontact
