#include <ddacontact/time/caught_corners.hpp>

#include <ddacontact/contact/contact_properties.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// Of the smaller block.
constexpr double highest_step = 0.01;

/// A vertex of a block's outline.
struct OutlineVertex {
  int block, vertex;
  auto operator<=>(const OutlineVertex&) const = default;
};

int next_of(const BlockSystem& blocks, const OutlineVertex& corner) {
  return corner.vertex + 1 < blocks.block(corner.block).vertices().count ? corner.vertex + 1 : 0;
}

int before(const BlockSystem& blocks, const OutlineVertex& corner) {
  return (corner.vertex > 0 ? corner.vertex : blocks.block(corner.block).vertices().count) - 1;
}

int index_of(const BlockSystem& blocks, const OutlineVertex& vertex) {
  return blocks.block(vertex.block).vertices().first + vertex.vertex;
}

Vec2 place_of(const BlockSystem& blocks, const BlockState& state, const OutlineVertex& vertex) {
  return state.origin.col(vertex.block) + state.position.col(index_of(blocks, vertex));
}

/// Distances from the line of an edge, positive inside its block, at the start and now.
class Line {
 public:
  Line(const BlockSystem& blocks, const BlockState& state, const OutlineVertex& edge)
      : blocks_(blocks), state_(state), from_(edge), to_{edge.block, next_of(blocks, edge)} {}

  double at_start(const OutlineVertex& corner) const {
    return inside(start(from_), start(to_), start(corner));
  }
  double now(const OutlineVertex& corner) const { return inside(place(from_), place(to_), place(corner)); }

 private:
  static double inside(const Vec2& from, const Vec2& to, const Vec2& x) {
    return polyfem::cross(to - from, x - from) / (to - from).norm();
  }
  Vec2 start(const OutlineVertex& c) const { return blocks_.block(c.block).reference().col(c.vertex); }
  Vec2 place(const OutlineVertex& c) const { return place_of(blocks_, state_, c); }

  const BlockSystem& blocks_;
  const BlockState& state_;
  OutlineVertex from_, to_;
};

/// A corner pressed against another block close to a corner of that one: either may be the contact's vertex.
struct Meeting {
  OutlineVertex corner, other;
  double size;  ///< of the smaller block
};

/// A corner that presses on an edge, or did at the start of the step.
struct Bearing {
  OutlineVertex corner, edge;
};

/// Whether the step from the edge to the corner was not there at the start, with its block behind the edge's
/// line.
bool was_flush(const BlockSystem& blocks, const Line& line, const OutlineVertex& corner, double size) {
  const double lip = ContactProperties::default_lip * size;
  return std::abs(line.at_start(corner)) <= lip &&
         line.at_start({corner.block, before(blocks, corner)}) >= -lip &&
         line.at_start({corner.block, next_of(blocks, corner)}) >= -lip;
}

}  // namespace

int find_caught_block(const BlockSystem& blocks, const BlockState& state,
                      const std::vector<Contact>& contacts) {
  const auto distance = [&](const OutlineVertex& a, const OutlineVertex& b) {
    return (place_of(blocks, state, a) - place_of(blocks, state, b)).norm();
  };
  const auto presses = [](const Contact& contact) { return contact.normal > 0 && !contact.motion.rounding; };
  std::vector<Meeting> meetings;
  for (const Contact& contact : contacts) {
    if (!presses(contact)) continue;
    const OutlineVertex vertex{contact.pair.vertex_block, contact.pair.vertex},
        start{contact.pair.edge_block, contact.pair.edge}, end{start.block, next_of(blocks, start)},
        nearer = distance(vertex, start) < distance(vertex, end) ? start : end;
    if (distance(vertex, nearer) > highest_step * contact.size) continue;
    meetings.push_back({vertex, nearer, contact.size});
    meetings.push_back({nearer, vertex, contact.size});
  }
  if (meetings.empty()) return -1;

  std::vector<bool> meets(static_cast<std::size_t>(state.position.cols()), false);
  for (const Meeting& meeting : meetings) meets[index_of(blocks, meeting.corner)] = true;
  std::vector<Bearing> bearings;
  for (const Contact& contact : contacts) {
    const OutlineVertex vertex{contact.pair.vertex_block, contact.pair.vertex};
    const bool bears = contact.normal > 0 || contact.start_state != ContactState::open;
    if (bears && !contact.motion.rounding && meets[index_of(blocks, vertex)])
      bearings.push_back({vertex, {contact.pair.edge_block, contact.pair.edge}});
  }
  std::ranges::sort(bearings, {}, &Bearing::corner);

  for (const auto& [corner, other, size] : meetings)
    for (const Bearing& bearing : std::ranges::equal_range(bearings, corner, {}, &Bearing::corner)) {
      if (bearing.edge.block == other.block) continue;
      const Line line(blocks, state, bearing.edge);
      const double step = -line.now(other);
      if (step > ContactProperties::default_lip * size && step <= highest_step * size &&
          was_flush(blocks, line, other, size))
        return corner.block;
    }
  return -1;
}

}  // namespace ddacontact
