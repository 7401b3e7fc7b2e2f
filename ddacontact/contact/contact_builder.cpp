#include <ddacontact/contact/contact_builder.hpp>

#include <ddacontact/block/for_blocks.hpp>
#include <ddacontact/contact/kinematics.hpp>
#include <ddacontact/core/bytes_of.hpp>
#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/entries.hpp>
#include <ddacontact/detection/half_width.hpp>
#include <polyfem/core/parallel.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <ranges>

namespace ddacontact {

namespace {

/// Two places nearer than this times the block size are one; a contact nearer than this touches.
constexpr double coincidence = 1e-6;
/// Two corners nearer than this times the block size may hand a contact from one's vertex to the other's.
constexpr double near_corner = 1e-2;
/// A vertex this times the block size inside another block went into it.
constexpr double entered_depth = 1e-5;
/// Pairs of blocks are looked for so many reaches further than they have to be.
constexpr double skin_of_reach = 4;
/// What one thread works on at a time.
constexpr Index blocks_of_range = 512, pairs_of_range = 256;

/// The contacts of one pair of blocks stand together: ordered by the pair, then by contact.
Pair block_pair(const VertexEdge& contact) {
  return {std::min(contact.vertex_block, contact.edge_block),
          std::max(contact.vertex_block, contact.edge_block)};
}

/// Of contacts ordered by their pairs, those of the pair of this one.
auto of_same_pair(const VertexEdge& contact, auto& contacts) {
  return std::ranges::equal_range(contacts, block_pair(contact), {},
                                  [](const Contact& of) { return block_pair(of.pair); });
}

bool is_among(const VertexEdge& contact, const auto& contacts) {
  return std::ranges::any_of(contacts, [&](const Contact& of) { return of.pair == contact; });
}

/// Of contacts ordered by their pairs, those of one pair after the other.
class ContactsByPair {
 public:
  /// Pairs from `first` on, in order.
  ContactsByPair(const std::vector<ContactRecord>& contacts, const Pair& first)
      : end_(contacts.data() + contacts.size()),
        from_(std::lower_bound(
            contacts.data(), end_, first,
            [](const ContactRecord& contact, const Pair& pair) { return block_pair(contact.pair) < pair; })),
        to_(from_) {}

  std::span<const ContactRecord> of(const Pair& pair) {
    if (from_ != to_ && block_pair(from_->pair) == pair) return {from_, to_};
    for (from_ = to_; from_ != end_ && block_pair(from_->pair) < pair;) ++from_;
    for (to_ = from_; to_ != end_ && block_pair(to_->pair) == pair;) ++to_;
    return {from_, to_};
  }

 private:
  const ContactRecord *end_, *from_, *to_;
};

}  // namespace

JointLaw ContactProperties::law(const ContactRecord& contact) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const JointStrength& joint = strength(contact.pair);
  const bool glued = joint.glued && contact.closed();
  return {.normal_stiffness = normal_stiffness,
          .tangential_stiffness = tangential_stiffness,
          .friction = joint.friction,
          .friction_law = joint.friction_law ? &joint.friction_law : nullptr,
          .cohesion = glued ? infinity : joint.cohesion * contact.history.length,
          .tension = glued ? infinity : joint.tensile_strength * contact.history.length,
          .glued = glued};
}

ContactBuilder::ContactBuilder(const BlockSystem& blocks, ContactProperties properties)
    : blocks_(blocks), properties_(std::move(properties)) {
  std::vector<int> n_vertices;
  half_width_.reserve(static_cast<std::size_t>(blocks.n_blocks()));
  size_.reserve(static_cast<std::size_t>(blocks.n_blocks()));
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    half_width_.push_back(half_width(block.reference().leftCols(block.n_vertices())));
    size_.push_back(block.size());
    n_vertices.push_back(block.n_vertices());
  }
  outlines_ = OutlineTable(n_vertices);
}

double ContactBuilder::pair_size(int a, int b) const {
  if (!blocks_.is_movable(a)) return size_[b];
  if (!blocks_.is_movable(b)) return size_[a];
  return std::min(size_[a], size_[b]);
}

void ContactBuilder::find_pairs(const BlockState& state, const std::vector<double>& reach) {
  const Index n = blocks_.n_blocks();
  boxes_.resize(n);
  margins_.resize(keeps_pairs_ ? n : 0);
  const auto look_at_blocks = [&](Index begin, Index end) {
    for (int b = static_cast<int>(begin); b < end; ++b) {
      const Range& v = blocks_.block(b).vertices();
      outlines_.set(b, state.position.middleCols(v.first, v.count));
      const Box& box = outlines_[b].box;
      const Vec2 origin = state.origin.col(b), margin = Vec2::Constant(reach[b]);
      boxes_[b] = {box.low - margin + origin, box.high + margin + origin};
      if (keeps_pairs_) margins_[b] = skin_of_reach * reach[b];
    }
  };
  polyfem::for_ranges(n, blocks_of_range, std::ref(look_at_blocks));
  nearby_.find(boxes_, margins_, pairs_);
  std::erase_if(pairs_, [&](const Pair& pair) {
    const auto [a, b] = pair;
    return (!blocks_.is_movable(a) && !blocks_.is_movable(b)) || !blocks_.is_present(a) ||
           !blocks_.is_present(b);
  });
}

void ContactBuilder::find_contacts_of(const Pair& pair, const BlockState& state,
                                      const std::vector<double>& reach, std::span<const VertexEdge> closed,
                                      std::vector<VertexEdge>& found) const {
  thread_local Points shifted;
  const auto [a, b] = pair;
  const PairLimits limits{.reach = reach[a] + reach[b],
                          .max_depth = std::min(half_width_[a], half_width_[b]),
                          .coincidence = coincidence * pair_size(a, b)};
  // The origin of either block serves, as long as it is always that of the smaller index.
  const Range &of_a = blocks_.block(a).vertices(), &of_b = blocks_.block(b).vertices();
  if (shifted.cols() < of_b.count) shifted.resize(2, of_b.count);
  const Vec2 shift = state.origin.col(b) - state.origin.col(a);
  shifted.leftCols(of_b.count) = state.position.middleCols(of_b.first, of_b.count).colwise() + shift;
  OutlineSides sides_b = outlines_[b];
  sides_b.box = {sides_b.box.low + shift, sides_b.box.high + shift};
  find_contacts({a, state.position.middleCols(of_a.first, of_a.count)}, outlines_[a],
                {b, shifted.leftCols(of_b.count)}, sides_b, limits, closed, found);
}

std::size_t ContactBuilder::detect(const BlockState& state, const std::vector<double>& reach,
                                   const std::vector<ContactRecord>& previous) {
  find_pairs(state, reach);
  const Index n = static_cast<Index>(pairs_.size());
  found_in_.resize(static_cast<std::size_t>((n + pairs_of_range - 1) / pairs_of_range));
  const auto look_at_pairs = [&](Index begin, Index end) {
    thread_local std::vector<VertexEdge> closed;
    ContactsByPair old(previous, pairs_[begin]);
    std::vector<VertexEdge>& found = found_in_[begin / pairs_of_range];
    found.clear();
    for (Index p = begin; p < end; ++p) {
      closed.clear();
      for (const ContactRecord& contact : old.of(pairs_[p]))
        if (contact.closed()) closed.push_back(contact.pair);
      find_contacts_of(pairs_[p], state, reach, closed, found);
    }
  };
  polyfem::for_ranges(n, pairs_of_range, std::ref(look_at_pairs));
  first_found_.assign(1, 0);
  for (const auto& found : found_in_) first_found_.push_back(first_found_.back() + found.size());
  return first_found_.back();
}

MovingVertexEdge ContactBuilder::motion(const BlockState& state, const VertexEdge& pair) const {
  const Block &vertex_block = blocks_.block(pair.vertex_block), &edge_block = blocks_.block(pair.edge_block);
  const int next = (pair.edge + 1) % edge_block.n_vertices();
  const Vec2 shift = state.origin.col(pair.vertex_block) - state.origin.col(pair.edge_block);
  const auto place = [&](const Block& block, int v) -> Vec2 {
    return state.position.col(block.vertices().first + v);
  };
  return {{place(vertex_block, pair.vertex) + shift, place(edge_block, pair.edge), place(edge_block, next)},
          vertex_block.vertex_map(pair.vertex),
          edge_block.vertex_map(pair.edge),
          edge_block.vertex_map(next)};
}

double ContactBuilder::dashpot(const VertexEdge& pair) const {
  const double ratio = properties_.strength(pair).dashpot;
  if (ratio == 0) return 0;
  double lighter = std::numeric_limits<double>::infinity();
  for (int b : {pair.vertex_block, pair.edge_block})
    if (blocks_.is_movable(b)) lighter = std::min(lighter, blocks_.block(b).mass_total());
  return 2 * ratio * std::sqrt(properties_.normal_stiffness * lighter);
}

Contact ContactBuilder::make_contact(const BlockState& state, const VertexEdge& pair) const {
  Contact contact;
  contact.pair = pair;
  contact.motion = motion(state, pair);
  contact.gap = contact.first_gap().constant;
  const auto& [i, j, k] = contact.motion.start;
  contact.history.lock = edge_fraction(i, j, k);
  const Range& v = blocks_.block(pair.edge_block).vertices();
  const PointsRef outline = state.position.middleCols(v.first, v.count);
  const auto sides = outlines_[pair.edge_block].sides;
  if (sides[pair.edge].corner == Corner::straight)
    contact.straight_before = straight_before_start(outline, pair.edge);
  if (sides[next(pair.edge, outline)].corner == Corner::straight)
    contact.straight_after = straight_beyond_end(outline, pair.edge);
  contact.size = pair_size(pair.vertex_block, pair.edge_block);
  contact.law = properties_.law(contact);
  return contact;
}

std::vector<Contact> ContactBuilder::build_first(const BlockState& state, const std::vector<double>& reach) {
  std::vector<Contact> contacts;
  contacts.reserve(detect(state, reach, {}));
  for (const VertexEdge& pair : found_in_ | std::views::join) {
    Contact contact = make_contact(state, pair);
    ContactHistory& history = contact.history;
    if (contact.gap <= coincidence * pair_size(pair.vertex_block, pair.edge_block) &&
        contact.is_on_edge(contact.first_slip().constant)) {
      history.bonded = true;
      history.gap_offset = properties_.strength(pair).glued ? contact.gap : std::min(contact.gap, 0.0);
      const int origin = pair.edge_block;
      history.length = contact_length(blocks_.outline_from(state, pair.vertex_block, origin), pair.vertex,
                                      blocks_.outline_from(state, pair.edge_block, origin), pair.edge);
      contact.law = properties_.law(contact);
      history.state = contact.law.frictionless() ? ContactState::slip_forward : ContactState::stick;
    }
    if (properties_.strength(pair).glued) glue(contact);
    contacts.push_back(contact);
  }
  return contacts;
}

const ContactRecord* ContactBuilder::find_predecessor(const BlockState& state, const VertexEdge& pair,
                                                      std::span<const ContactRecord> previous) const {
  for (const ContactRecord& old : previous)
    if (old.lasts() && old.pair == pair) return &old;
  const Range& of_edge = blocks_.block(pair.edge_block).vertices();
  const auto edge_outline = state.position.middleCols(of_edge.first, of_edge.count);
  for (const ContactRecord& old : previous) {
    const bool same_vertex = old.pair.vertex_block == pair.vertex_block && old.pair.vertex == pair.vertex;
    if (old.lasts() && same_vertex &&
        (goes_straight_on(edge_outline, old.pair.edge, pair.edge) ||
         goes_straight_on(edge_outline, pair.edge, old.pair.edge)))
      return &old;
  }
  const auto place = [&](int block, int vertex) -> Vec2 {
    const Vec2 shift = state.origin.col(block) - state.origin.col(pair.edge_block);
    return state.position.col(blocks_.block(block).vertices().first + vertex) + shift;
  };
  const double near = near_corner * pair_size(pair.vertex_block, pair.edge_block);
  for (const ContactRecord& old : previous) {
    const bool exchanged = old.pair.vertex_block == pair.edge_block;
    if (!old.lasts() || !exchanged) continue;
    const auto ends = [&](int vertex, int edge, int block) {
      return vertex == edge || vertex == (edge + 1) % blocks_.block(block).n_vertices();
    };
    if (ends(old.pair.vertex, pair.edge, pair.edge_block) &&
        ends(pair.vertex, old.pair.edge, old.pair.edge_block) &&
        (place(pair.vertex_block, pair.vertex) - place(old.pair.vertex_block, old.pair.vertex)).norm() <=
            near)
      return &old;
  }
  return nullptr;
}

Contact ContactBuilder::carry_on(const BlockState& state, const VertexEdge& pair,
                                 std::span<const ContactRecord> previous) const {
  Contact contact = make_contact(state, pair);
  const double fraction = contact.history.lock;
  const ContactRecord* old = find_predecessor(state, pair, previous);
  if (old && !old->closed()) {
    contact.history.gap_offset = old->history.gap_offset;
  } else if (old) {
    contact.history = old->history;
    contact.law = properties_.law(contact);
    // Slip keeps its sign: the edges run the same way, or they are antiparallel, and so are the roles of
    // their blocks.
    if (old->pair != pair) contact.history.lock = fraction - old->end_slip / contact.edge_length();
    if (is_slipping(contact.history.state)) contact.history.lock = fraction;
  }
  if (!contact.closed() && contact.gap - contact.history.gap_offset < -contact.length_tolerance() &&
      contact.is_on_edge(contact.first_slip().constant))
    contact.history.state = contact.law.frictionless() ? ContactState::slip_forward : ContactState::stick;
  if (properties_.strength(pair).glued) glue(contact);
  return contact;
}

void ContactBuilder::glue(Contact& contact) const {
  ContactHistory& history = contact.history;
  if (!contact.closed()) {
    const bool touches = std::abs(contact.gap - history.gap_offset) <= coincidence * contact.size &&
                         contact.is_on_edge(contact.first_slip().constant);
    if (!touches) return;
    history.gap_offset = contact.gap;
  }
  history.state = ContactState::stick;
  contact.law = properties_.law(contact);
}

void ContactBuilder::restart(Contact& contact) const {
  contact.history.state = contact.start_state;
  contact.history.bonded = contact.start_bonded;
  contact.law.normal_stiffness = properties_.normal_stiffness;
  contact.law.tangential_stiffness = properties_.tangential_stiffness;
  contact.end_gap = contact.end_slip = contact.normal = contact.shear = 0;
  contact.was_closed = false;
  contact.gap_stays = contact.slip_stays = 0;
  contact.gap = contact.first_gap().constant;
}

void ContactBuilder::build(const BlockState& state, const std::vector<double>& reach,
                           const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts) {
  contacts.resize(detect(state, reach, previous));
  const auto carry_on_range = [&](Index begin, Index /*end*/) {
    const std::vector<VertexEdge>& found = found_in_[begin];
    if (found.empty()) return;
    ContactsByPair old(previous, block_pair(found.front()));
    for (std::size_t k = 0; k < found.size(); ++k)
      contacts[first_found_[begin] + k] = carry_on(state, found[k], old.of(block_pair(found[k])));
  };
  polyfem::for_ranges(static_cast<Index>(found_in_.size()), 1, std::ref(carry_on_range));
}

bool ContactBuilder::may_have_entered(int a, int b, const BlockState& end) const {
  const Range& of_a = blocks_.block(a).vertices();
  const Vec2 shift = end.origin.col(a) - end.origin.col(b),
             depth = Vec2::Constant(entered_depth / 2 * pair_size(a, b));
  const Box within{boxes_[b].low + depth, boxes_[b].high - depth};
  for (int v = of_a.first; v < of_a.end(); ++v) {
    const Vec2 x = end.position.col(v) + shift;
    if (touch({x, x}, within)) return true;
  }
  return false;
}

bool ContactBuilder::find_entered(const BlockState& start, const BlockState& end,
                                  const std::vector<Contact>& contacts) {
  entered_.clear();
  for_blocks(blocks_.n_blocks(), [&](int b) {
    const Range& v = blocks_.block(b).vertices();
    boxes_[b] = bounding_box(end.position.middleCols(v.first, v.count));
  });
  for (const auto& [a, b] : pairs_) {
    if (!may_have_entered(a, b, end) && !may_have_entered(b, a, end)) continue;
    const auto from_origin_of_a = [&, origin = start.origin.col(a)](const BlockState& state, int block) {
      const Range& v = blocks_.block(block).vertices();
      const Vec2 shift = state.origin.col(block) - origin;
      return Points(state.position.middleCols(v.first, v.count).colwise() + shift);
    };
    const Points start_a = from_origin_of_a(start, a), end_a = from_origin_of_a(end, a),
                 start_b = from_origin_of_a(start, b), end_b = from_origin_of_a(end, b);
    find_entries({a, start_a, end_a}, {b, start_b, end_b}, entered_depth * pair_size(a, b), entered_);
  }
  std::erase_if(entered_,
                [&](const VertexEdge& entry) { return is_among(entry, of_same_pair(entry, contacts)); });
  return !entered_.empty();
}

void ContactBuilder::add_entered(const BlockState& start, std::vector<Contact>& contacts) {
  for (const VertexEdge& entry : entered_) {
    const auto same_pair = of_same_pair(entry, contacts);
    if (is_among(entry, same_pair)) continue;
    contacts.insert(same_pair.end(), make_contact(start, entry));
  }
}

double ContactBuilder::memory() const {
  double bytes = bytes_of(properties_.materials) + bytes_of(half_width_) + bytes_of(size_) +
                 outlines_.memory() + nearby_.memory() + bytes_of(boxes_) + bytes_of(margins_) +
                 bytes_of(pairs_) + bytes_of(found_in_) + bytes_of(first_found_) + bytes_of(entered_);
  for (const std::vector<VertexEdge>& found : found_in_) bytes += bytes_of(found);
  return bytes;
}

}  // namespace ddacontact
