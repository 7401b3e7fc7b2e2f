// Where contacts of two faces are along them, and the lengths that they stand for.
#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/detection/contact_length.hpp>
#include <ddacontact/detection/corner.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ddacontact {

/// Two vertices nearer to each other than this part of the shorter edge that they meet are at one place. What
/// moves a contact by less of its own motion does not.
constexpr double same_place = near_corner;

bool ContactBuilder::are_at_one_place(const BlockState& state, const VertexEdge& a,
                                      const VertexEdge& b) const {
  const bool same_vertex = a.vertex_block == b.vertex_block;
  if (a == b || a.corner || b.corner || (same_vertex && a.vertex != b.vertex)) return false;
  if (!properties_.strength(a).is_compliant() && !blocks_.has_rounded_corners()) return false;
  const VertexEdgePositions one = positions_of(blocks_, state, a), other = positions_of(blocks_, state, b);
  const Vec2 apart = other.i + (state.origin.col(b.edge_block) - state.origin.col(a.edge_block)) - one.i;
  // Edges of one face run the same way, those of two faces that touch against each other.
  const Vec2 along = one.k - one.j, along_other = (same_vertex ? 1 : -1) * (other.k - other.j);
  const double length = along.norm(), of_other = along_other.norm();
  return along.dot(along_other) > 0 &&
         std::abs(cross(along, along_other)) <= sin_parallel * length * of_other &&
         std::abs(apart.dot(along)) <= same_place * std::min(length, of_other) * length;
}

bool ContactBuilder::is_moved(const Contact& contact, const VertexEdgeForm& by) const {
  bool moved = false;
  contact.motion.form(by.gradient).for_terms([&](int unknown, double c) {
    moved = moved || (blocks_.equation()[unknown] >= 0 && std::abs(c) > same_place);
  });
  return moved;
}

bool ContactBuilder::can_change(const BlockState& state, const VertexEdge& pair,
                                std::span<const ContactRecord> previous) const {
  Contact contact;
  contact.motion = motion_of(blocks_, state, pair);
  const VertexEdgePositions positions = contact.motion.slip_positions();
  contact.history.lock = edge_fraction(positions.i, positions.j, positions.k);
  const JointStrength& joint = properties_.strength(pair);
  const bool bonded = joint.glued || ((joint.cohesion > 0 || joint.tensile_strength > 0) &&
                                      (previous.empty() || std::ranges::any_of(previous, [&](const auto& of) {
                                         return of.pair == pair && of.history.bonded;
                                       })));
  return is_moved(contact, contact.first_gap()) || (bonded && is_moved(contact, contact.first_slip()));
}

void ContactBuilder::leave_out_friction(Contact& contact) const {
  if (blocks_.is_free(contact.pair.vertex_block) || blocks_.is_free(contact.pair.edge_block) ||
      is_moved(contact, contact.first_gap()))
    return;
  contact.law.friction = 0;
  contact.law.friction_law = nullptr;
}

void ContactBuilder::leave_one_a_place(const BlockState& state, std::span<const ContactRecord> previous,
                                       std::vector<VertexEdge>& found, std::size_t first) const {
  const std::vector<VertexEdge> of_blocks(found.begin() + static_cast<std::ptrdiff_t>(first), found.end());
  const auto order = [&](const VertexEdge& of) {
    const bool was_closed = std::ranges::any_of(previous, [&](const ContactRecord& before) {
      return before.closed() && before.pair.vertex_block == of.vertex_block &&
             before.pair.vertex == of.vertex;
    });
    const bool is_straight = outlines_[of.vertex_block].sides[of.vertex].corner == Corner::straight;
    return std::tuple(!was_closed, length_of(state, of, bearing({})).total() == 0, is_straight, of);
  };
  for (const VertexEdge& of : of_blocks)
    if (std::ranges::any_of(of_blocks, [&](const VertexEdge& other) {
          return are_at_one_place(state, of, other) && order(other) < order(of);
        }))
      std::erase(found, of);
}

std::function<bool(int, int)> ContactBuilder::bearing(std::span<const VertexEdge> found) {
  return [found](int block, int vertex) {
    return std::ranges::any_of(
        found, [&](const VertexEdge& of) { return of.vertex_block == block && of.vertex == vertex; });
  };
}

ContactLength ContactBuilder::length_of(const BlockState& state, const VertexEdge& pair,
                                        const std::function<bool(int, int)>& bears) const {
  const int origin = pair.edge_block;
  const Block& block = blocks_.block(pair.vertex_block);
  return contact_length(blocks_.outline_from(state, pair.vertex_block, origin),
                        blocks_.outline_from(state, pair.edge_block, origin), pair,
                        block.reference().leftCols(block.n_vertices()), bears,
                        properties_.strength(pair).is_compliant() || properties_.strength(pair).crushes());
}

void ContactBuilder::set_length(const BlockState& state, std::span<const VertexEdge> found,
                                ContactRecord& contact) const {
  contact.history.length = length_of(state, contact.pair, bearing(found)).total();
  set_length_beyond(state, contact);
}

void ContactBuilder::set_length_beyond(const BlockState& state, ContactRecord& contact) const {
  ContactHistory& history = contact.history;
  const VertexEdge& pair = contact.pair;
  history.length_beyond = 0;
  if (properties_.edge_joints.empty()) return;
  const ContactLength length =
      length_of(state, pair, [&](int block, int) { return block == pair.vertex_block; });
  if (length.edge_beyond < 0 || length.total() == 0) return;
  VertexEdge beyond = pair;
  beyond.edge = length.edge_beyond;
  if (properties_.joint_of(beyond) == properties_.joint_of(pair)) return;
  const bool is_next = beyond.edge == (pair.edge + 1) % blocks_.block(beyond.edge_block).n_vertices();
  const double part = history.length * length.beyond / length.total();
  history.length_beyond = static_cast<float>(is_next ? part : -part);
}

}  // namespace ddacontact
