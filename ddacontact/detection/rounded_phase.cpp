#include <ddacontact/detection/rounded_phase.hpp>

#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/directed_edge.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

namespace {

/// Around what a motion takes a point through.
Box way(const Vec2& start, const Vec2& end) {
  return {start.cwiseMin(end), start.cwiseMax(end)};
}

/// A rounded polygon at a moment of its predicted motion.
struct RoundedOutline : RoundedPolygon {
  int size() const { return static_cast<int>(outline.vertices.cols()); }
  int after(int v) const { return next(v, outline.vertices); }
  int before(int v) const { return previous(v, outline.vertices); }
  Vec2 vertex(int v, double time) const {
    return (1 - time) * outline.vertices.col(v) + time * outline.moved.col(v);
  }
  DirectedEdge edge(int e, double time) const { return {vertex(e, time), vertex(after(e), time)}; }
  Vec2 centre(int v, double of_radius, double time) const {
    return rounded.centre(v, of_radius).at(vertex(v, time), vertex(after(v), time));
  }
  Vec2 centre(int v, double time) const { return centre(v, radius, time); }
  /// Around what the motion takes an edge through.
  Box box_of_edge(int e) const {
    return joined(way(vertex(e, 0), vertex(e, 1)), way(vertex(after(e), 0), vertex(after(e), 1)));
  }
  /// Whether a direction from corner v, or from its centre, is between the normals of its edges.
  bool faces(int v, const Vec2& direction, double time) const {
    return rounded.corners[v].is_arc && direction.dot(edge(before(v), time).tangent) > 0 &&
           direction.dot(edge(v, time).tangent) < 0;
  }
};

/// Of a circle's centre and an edge's line; `from_end` is from the nearer of the arcs at its ends.
struct OverEdge {
  double gap, overshoot, from_end;

  OverEdge(const RoundedOutline& a, int i, const RoundedOutline& b, int e, double time) {
    const DirectedEdge edge = b.edge(e, time);
    const auto cut = [&](int v) { return b.rounded.cut(v, b.edge(v, time).length, b.met_radii[v]); };
    const Vec2 centre = a.centre(i, time);
    const double along = edge.along(centre);
    gap = edge.gap(centre) - a.radius;
    overshoot = edge.overshoot(centre);
    from_end = std::min(along - cut(e), edge.length - cut(b.after(e)) - along);
  }
};

bool was_closed(std::span<const EarlierContact> earlier, const VertexEdge& contact) {
  return std::ranges::any_of(earlier,
                             [&](const EarlierContact& of) { return of.closed && of.pair == contact; });
}

struct CirclesOnOutline {
  const RoundedOutline &a, &b;
  const PairLimits& limits;
  std::span<const EarlierContact> earlier;
  std::vector<VertexEdge>& met;
  std::vector<Choice>& choices;
  double radius = a.radius;
  std::vector<Box> boxes{};  ///< of b's edges, with how near a centre has to come
  std::vector<int> near{};   ///< edges of b that the circle at hand may come near

  void find() {
    const double reach = 2 * radius + std::max(limits.search_margin, limits.max_depth);
    for (int e = 0; e < b.size(); ++e) boxes.push_back(widened(b.box_of_edge(e), reach));
    Box around = boxes.front();
    for (const Box& box : boxes) around = joined(around, box);
    for (int i = 0; i < a.size(); ++i) {
      const Box centre = way(a.centre(i, 0), a.centre(i, 1));
      if (corner_at(a.outline.vertices, i) == Corner::reflex || !touch(centre, around)) continue;
      near.clear();
      for (int e = 0; e < b.size(); ++e)
        if (touch(centre, boxes[e])) near.push_back(e);
      const double time = time_of_entry(i);
      for (int e : near) {
        add_edge(i, e, time);
        add_corner(i, e, time);
      }
    }
  }

  /// When the motion takes the circle deep into the other outline; 1: not within the step.
  double time_of_entry(int i) const {
    const double level = -radius / 2;
    double earliest = 1;
    for (int e : near) {
      const OverEdge start(a, i, b, e, 0), end(a, i, b, e, 1);
      if (start.gap < level || end.gap >= level) continue;
      const double time = (start.gap - level) / (start.gap - end.gap);
      const OverEdge then(a, i, b, e, time);
      if (then.overshoot <= radius) earliest = std::min(earliest, time);
    }
    return earliest;
  }

  void add_edge(int i, int e, double time) {
    const VertexEdge contact{a.outline.block, i, b.outline.block, e};
    const OverEdge over(a, i, b, e, time);
    // A joint with stiffness may close by more than the radius.
    const double deepest = was_closed(earlier, contact) ? std::max(limits.max_depth, radius) : radius;
    if (over.gap > limits.search_margin || over.gap <= -deepest) return;
    if (over.from_end >= -limits.coincidence) add(contact, over.from_end);
  }
  void add_corner(int i, int j, double time) {
    const Vec2 apart = a.centre(i, time) - b.centre(j, b.met_radii[j], time);
    if (apart.norm() - radius - b.met_radii[j] > limits.search_margin || !b.faces(j, apart, time) ||
        !a.faces(i, -apart, time))
      return;
    for (int e : {j, b.before(j)})  // it meets that there
      if (OverEdge(a, i, b, e, time).from_end >= -limits.coincidence) return;
    add({a.outline.block, i, b.outline.block, j, true}, 0);
  }
  void add(const VertexEdge& contact, double from_end) {
    met.push_back(contact);
    if (from_end <= limits.search_margin) choices.push_back({contact, false, true});
  }
};

/// Whether contacts p of a's vertex and q of b's are the same two arcs, or the same end of two edges that lie on
/// each other.
bool are_one_place(const VertexEdge& p, const RoundedOutline& a, const VertexEdge& q, const RoundedOutline& b,
                   double coincidence) {
  if (p.vertex_block != a.outline.block || q.vertex_block != b.outline.block || p.corner != q.corner)
    return false;
  if (p.corner)
    return p.vertex == q.edge && q.vertex == p.edge && a.met_radii[p.vertex] == a.radius &&
           b.met_radii[q.vertex] == b.radius;
  const auto ends = [](int vertex, int edge, const RoundedOutline& of) {
    return vertex == edge || vertex == of.after(edge);
  };
  if (!ends(q.vertex, p.edge, b) || !ends(p.vertex, q.edge, a)) return false;
  const Vec2 tangent = b.edge(p.edge, 1).tangent;
  return std::abs(cross(tangent, a.edge(q.edge, 1).tangent)) <= sin_parallel &&
         std::abs(tangent.dot(a.vertex(p.vertex, 1) - b.vertex(q.vertex, 1))) <= coincidence;
}

}  // namespace

void find_rounded_contacts(const RoundedPolygon& a, const RoundedPolygon& b, const PairLimits& limits,
                           std::span<const EarlierContact> earlier, FoundContacts& found) {
  assert(std::ssize(a.rounded.corners) == a.outline.vertices.cols() && a.radius > 0);
  assert(std::ssize(b.rounded.corners) == b.outline.vertices.cols() && b.radius > 0);
  const RoundedOutline of_a{a}, of_b{b};
  std::vector<VertexEdge> met;
  CirclesOnOutline{of_a, of_b, limits, earlier, met, found.choices}.find();
  CirclesOnOutline{of_b, of_a, limits, earlier, met, found.choices}.find();
  std::vector<char> dropped(met.size(), 0);
  for (std::size_t p = 0; p < met.size(); ++p)
    for (std::size_t q = 0; q < met.size(); ++q)
      if (!dropped[p] && !dropped[q] && are_one_place(met[p], of_a, met[q], of_b, limits.coincidence))
        dropped[was_closed(earlier, met[q]) && !was_closed(earlier, met[p]) ? p : q] = 1;
  for (std::size_t k = 0; k < met.size(); ++k)
    if (!dropped[k]) found.contacts.push_back(met[k]);
}

}  // namespace ddacontact
