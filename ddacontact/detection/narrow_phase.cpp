#include <ddacontact/detection/narrow_phase.hpp>

#include <ddacontact/detection/directed_edge.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <tuple>

namespace ddacontact {

namespace {

/// A corner that may touch edges: its place and its two sides.
struct VertexCorner {
  Vec2 x;
  std::array<Vec2, 2> sides;
  std::array<double, 2> lengths;
  std::array<bool, 2> covered{};

  VertexCorner(const Vec2& at, const Side& before, const Side& after)
      : x(at), sides{after.along(), -before.along()}, lengths{after.length, before.length} {}
  void go_on(int side, const Vec2& along) {
    sides[side] = along;
    lengths[side] = along.norm();
    covered[side] = true;
  }
  /// Whether it lies on the outer side of an edge with this normal, or may be turned there within the step.
  bool admissible(const Vec2& normal, double search_margin, double largest_turn) const {
    for (int k : {0, 1})
      if (normal.dot(sides[k]) <
          -std::max(sin_parallel * lengths[k], std::min(search_margin, largest_turn * lengths[k])))
        return false;
    return true;
  }
};

/// Gaps are those of the start, without the offset of an earlier contact.
struct Candidate {
  VertexEdge contact;
  double gap, overshoot;
  Vec2 normal;
  double offset;  ///< of the gap
  bool known;     ///< a contact before
  bool kept;      ///< and closed
  bool covered;
  bool strict = false;  ///< admissible as it stands, without turning within the step
  bool dropped = false;

  bool inside() const { return overshoot <= 0; }
  double aside() const { return std::max(overshoot, 0.0); }
  double distance() const { return std::hypot(gap, aside()); }
};

/// When the predicted motion takes a vertex past the line of an edge, and where it ends.
struct Passage {
  double time;  ///< as a part of the step; infinity: not within it
  double end_gap, end_overshoot;

  Passage(const Candidate& of, const Outline& vertex_outline, const Outline& edge_outline, double lip) {
    const DirectedEdge edge(edge_outline.moved, of.contact.edge);
    const Vec2 x = vertex_outline.moved.col(of.contact.vertex);
    end_gap = edge.gap(x) - of.offset;
    end_overshoot = edge.overshoot(x);
    time = end_gap >= -lip ? inf : of.gap <= -lip ? 0 : (of.gap + lip) / (of.gap - end_gap);
  }
};

/// By what the line that is passed last is found: the time; of those that are not passed the one that the motion
/// violates least, beyond what it was violated before and by more than forces press in, then an earlier contact.
/// One that a vertex behind it moves away from is not what stops it and counts with all of its violation. Where no
/// line is ever passed, by the paper's preset, gaps tell.
struct Order {
  double time, violation;
  bool kept;
  double end_gap;

  Order(const Candidate& of, const Passage& passage, const PairLimits& limits)
      : time(passage.time),
        violation(passage.end_gap - (passage.end_gap > of.gap ? 0 : std::min(of.gap, 0.0))),
        kept(of.kept),
        end_gap(passage.end_gap) {
    if (violation > -limits.pressed_in() || limits.lip == inf) violation = 0;
  }
  auto operator<=>(const Order&) const = default;
  /// Whether only round-off orders the two.
  bool ties_with(const Order& other, double pressed_in) const {
    return time == other.time && std::abs(violation - other.violation) <= pressed_in;
  }
};

struct NumberedEdge {
  int number;
  DirectedEdge edge;
};

/// Working arrays, kept between calls: pairs are many.
struct Workspace {
  std::vector<NumberedEdge> edges;
  std::vector<Candidate> at_vertex, in_b, in_a;
};

/// Null: there is none.
const EarlierContact* find_earlier(std::span<const EarlierContact> earlier, const VertexEdge& contact) {
  const auto same = std::ranges::find(earlier, contact, &EarlierContact::pair);
  return same == earlier.end() ? nullptr : &*same;
}

bool is_within(double distance, const Vec2& x) {
  return x.squaredNorm() <= distance * distance;
}

/// The entrance edges of the vertices of one polygon into another.
struct Entrances {
  const Outline &a, &b;
  const PairLimits& limits;
  std::span<const EarlierContact> earlier;
  std::span<const CoveredPart> covered;
  std::vector<NumberedEdge>& edges;  ///< of b that a may be near
  std::vector<Candidate>& near;      ///< of the vertex at hand
  std::vector<Choice>& choices;
  const OutlineSides &of_a = a.sides, &of_b = b.sides;

  void find(std::vector<Candidate>& found) {
    found.clear();
    edges.clear();
    // A vertex further from the polygon than the search margin is met by none of its edges.
    const double margin = limits.search_margin + 2 * limits.coincidence;
    const Box near_b = widened(of_b.box, margin);
    for (int i = 0; i < a.vertices.cols(); ++i) {
      const Vec2 x = a.vertices.col(i);
      if (!touch({x, x}, near_b) || of_a.sides[i].corner == Corner::reflex) continue;
      if (edges.empty()) collect_edges();
      add_entrances_of(i, found);
    }
  }

  void collect_edges() {
    const Box near_a =
        widened(of_a.box, std::max(limits.search_margin, limits.max_depth) + 2 * limits.coincidence);
    for (int e = 0; e < b.vertices.cols(); ++e) {
      const Vec2 p = b.vertices.col(e), q = b.vertices.col(next(e, b.vertices));
      if (touch({p.cwiseMin(q), p.cwiseMax(q)}, near_a)) edges.push_back({e, DirectedEdge(p, of_b.sides[e])});
    }
  }

  /// With what covers its sides.
  VertexCorner corner_at_vertex(int i) const {
    const int before = previous(i, a.vertices);
    VertexCorner corner(a.vertices.col(i), of_a.sides[before], of_a.sides[i]);
    for (const CoveredPart& part : covered) {
      if (part.block != a.block) continue;
      if (part.edge == i && part.from <= limits.lip) corner.go_on(0, part.before);
      if (part.edge == before && part.to >= of_a.sides[before].length - limits.lip)
        corner.go_on(1, part.after);
    }
    return corner;
  }

  bool is_covered(int e, double along) const {
    return std::ranges::any_of(covered, [&](const CoveredPart& part) {
      return part.block == b.block && part.edge == e && along >= part.from - limits.lip &&
             along <= part.to + limits.lip;
    });
  }

  void add_entrances_of(int i, std::vector<Candidate>& found) {
    const VertexCorner corner = corner_at_vertex(i);
    if (corner.covered[0] && corner.covered[1]) return;
    const Vec2& x = corner.x;
    near.clear();
    bool behind = false;
    for (const auto& [e, edge] : edges) {
      const VertexEdge contact{a.block, i, b.block, e};
      const EarlierContact* const before = find_earlier(earlier, contact);
      const double offset = before ? before->gap_offset : 0, gap = edge.gap(x) - offset;
      if (gap < -limits.max_depth || gap > limits.search_margin) continue;
      const double overshoot = edge.overshoot(x);
      const double aside = std::max(overshoot, 0.0), off = aside > 0 ? gap : std::max(gap, 0.0);
      if (!is_within(limits.search_margin, {off, aside})) continue;
      if (!corner.admissible(edge.normal, limits.search_margin, limits.largest_turn)) continue;
      const bool stays = overshoot <= limits.coincidence && before && before->closed;
      near.push_back({contact, gap, overshoot, edge.normal, offset, before != nullptr, stays,
                      is_covered(e, edge.tangent.dot(x - edge.start))});
      behind = behind || is_behind(near.back());
    }
    if (near.empty()) return;
    bool inside = false;
    if (behind) {
      inside = !is_outside(x);
      if (!inside) std::erase_if(near, [this](const Candidate& c) { return is_behind(c); });
    }
    if (!std::ranges::all_of(near, &Candidate::covered)) std::erase_if(near, &Candidate::covered);
    keep_nearest_of_straight_runs();
    if (near.size() > 1) choose(inside);
    for (Candidate& c : near) {
      c.strict = corner.admissible(c.normal, 0, 0);
      found.push_back(c);
    }
  }

  bool is_behind(const Candidate& c) const { return c.gap < -limits.depth_inside(); }

  /// Whether x has not passed all lines of a convex polygon; of another whether it is no deeper in it than
  /// that. Where none is passed: whether it is further outside than the coincidence.
  bool is_outside(const Vec2& x) {
    const bool by_passing = limits.lip < inf;
    if (!of_b.concave) {
      const double least = by_passing ? -limits.lip : limits.coincidence;
      for (int e = 0; e < b.vertices.cols(); ++e)
        if (DirectedEdge(b.vertices.col(e), of_b.sides[e]).gap(x) > least) return true;
      return false;
    }
    const bool on_outline = std::ranges::any_of(edges, [&](const NumberedEdge& of) {
      return is_within(limits.depth_inside(), {of.edge.gap(x), std::max(of.edge.overshoot(x), 0.0)});
    });
    return polyfem::contains(b.vertices, x) ? by_passing && on_outline : by_passing || !on_outline;
  }

  /// Of edges that are collinear the vertex is over one.
  void keep_nearest_of_straight_runs() {
    const auto joined = [this](const Candidate& p, const Candidate& q) {
      return are_collinear(b.vertices, p.contact.edge, q.contact.edge);
    };
    std::size_t last = 0;
    for (std::size_t k = 1; k < near.size(); ++k) {
      if (!joined(near[last], near[k]))
        near[++last] = near[k];
      else if (is_nearer(near[k], near[last]))
        near[last] = near[k];
    }
    if (near.empty()) return;
    near.resize(last + 1);
    if (last > 0 && joined(near.back(), near.front())) {
      if (!is_nearer(near.front(), near.back())) near.front() = near.back();
      near.pop_back();
    }
  }
  bool is_nearer(const Candidate& p, const Candidate& q) const {
    if (p.kept != q.kept) return p.kept;
    const double pressed_in = limits.pressed_in();
    if (std::abs(p.aside() - q.aside()) > pressed_in) return p.aside() < q.aside();
    return std::abs(p.gap) < std::abs(q.gap) - pressed_in;
  }

  /// Of edges between which a vertex can enter only once leaves the one whose line is passed last.
  void choose(bool inside) {
    const auto later = [this](const Candidate& p, const Candidate& q) {
      return std::pair(order(p), -p.contact.edge) > std::pair(order(q), -q.contact.edge);
    };
    std::ranges::sort(near, later);
    if (inside) came_in_through_the_nearest();
    std::size_t n_chosen = 1;
    for (std::size_t k = 1; k < near.size(); ++k) {
      const auto excludes = [&](const Candidate& c) {
        return !of_b.concave || turns_left(b.vertices, c.contact.edge, near[k].contact.edge) ||
               turns_left(b.vertices, near[k].contact.edge, c.contact.edge);
      };
      const auto chosen = near.begin() + static_cast<std::ptrdiff_t>(n_chosen),
                 excluding = std::find_if(near.begin(), chosen, excludes);
      if (excluding == chosen)
        near[n_chosen++] = near[k];
      else if (!inside)
        choices.push_back({excluding->contact,
                           order(*excluding).ties_with(order(near[k]), limits.pressed_in()),
                           excluding->kept});
    }
    near.resize(n_chosen);
  }
  Order order(const Candidate& of) const { return {of, Passage(of, a, b, limits.lip), limits}; }

  /// Of a vertex inside: first the edge it came through; of those it is behind else only kept ones and the
  /// other side of a notch.
  void came_in_through_the_nearest() {
    const auto came_less = [this](const Candidate& p, const Candidate& q) {
      const auto rank = [this](const Candidate& c) {
        return std::tuple(c.gap <= limits.coincidence, c.kept, -c.distance());
      };
      return rank(p) < rank(q);
    };
    const auto entrance = std::ranges::max_element(near, came_less);
    std::rotate(near.begin(), entrance, entrance + 1);
    const int of_entrance = near.front().contact.edge;
    std::erase_if(near, [&](const Candidate& c) {
      const int e = c.contact.edge;
      return is_behind(c) && !c.kept && e != of_entrance && !share_notch(e, of_entrance) &&
             !share_notch(of_entrance, e);
    });
  }
  /// Whether the outline goes from edge `from` to edge `to` by one reflex corner, else straight.
  bool share_notch(int from, int to) const {
    const PointsRef& polygon = b.vertices;
    int first = from;
    while (first != to && corner_at(polygon, next(first, polygon)) == Corner::straight)
      first = next(first, polygon);
    if (first == to || corner_at(polygon, next(first, polygon)) != Corner::reflex) return false;
    return are_collinear(polygon, next(first, polygon), to);
  }
};

/// The end of an edge that is nearer to x.
int nearer_end(const PointsRef& polygon, int edge, const Vec2& x) {
  const int end = next(edge, polygon);
  return (polygon.col(edge) - x).squaredNorm() <= (polygon.col(end) - x).squaredNorm() ? edge : end;
}

/// Whether the two contacts are between the same two corners: each one's vertex is the near end of the
/// other's edge.
bool share_corner(const Candidate& p, const Outline& a, const Candidate& q, const Outline& b,
                  double search_margin) {
  const int i = p.contact.vertex, j = q.contact.vertex;
  const Vec2 x_i = a.vertices.col(i), x_j = b.vertices.col(j);
  return nearer_end(b.vertices, p.contact.edge, x_i) == j &&
         nearer_end(a.vertices, q.contact.edge, x_j) == i && (x_i - x_j).norm() <= search_margin;
}

/// Vertex on vertex: decides which of the two stays, or both as the two ends of a short overlap.
void resolve_corner(Candidate& p, const Outline& a, Candidate& q, const Outline& b, const PairLimits& limits,
                    std::vector<Choice>& choices) {
  const bool parallel = p.normal.dot(q.normal) < 0 && std::abs(cross(p.normal, q.normal)) <= sin_parallel;
  const Passage of_p(p, a, b, limits.lip), of_q(q, b, a, limits.lip);
  const auto drop = [](Candidate& of) { of.dropped = true; };
  if (parallel) {
    const Vec2 distance = a.vertices.col(p.contact.vertex) - b.vertices.col(q.contact.vertex);
    const bool one_place = std::abs(cross(p.normal, distance)) <= limits.coincidence;
    const bool p_over = p.inside() || of_p.end_overshoot <= 0, q_over = q.inside() || of_q.end_overshoot <= 0;
    if (p.kept != q.kept && (one_place || !(p.kept ? q_over : p_over)))
      drop(p.kept ? q : p);
    else if (one_place && !p.kept && p.known != q.known)
      drop(p.known ? q : p);
    else if (p.kept == q.kept && p_over != q_over)
      drop(p_over ? q : p);
    else if (p.kept == q.kept && (!p_over || (one_place && !p.kept)))
      drop(p.gap >= q.gap ? q : p);
    // The one that stays is on the same line: what was preferred to others still is.
    const auto& [gone, stays] = p.dropped ? std::tie(p, q) : std::tie(q, p);
    for (Choice& choice : choices)
      if (gone.dropped && choice.chosen == gone.contact)
        choice = {stays.contact, choice.open, choice.kept || stays.kept};
  } else if (p.kept != q.kept && limits.lip == inf) {
    drop(p.kept ? q : p);
  } else if (p.strict != q.strict) {
    // One is an entrance only if its corner turns within the step: it may wait for that, open.
    Candidate& loose = p.strict ? q : p;
    loose.dropped = loose.gap <= 0;
  } else if (!p.strict && p.inside() != q.inside()) {
    // Both wait for a turn, as two sides that are nearly parallel do: they meet where a vertex is over one.
    drop(p.inside() ? q : p);
  } else {
    const Order order_p(p, of_p, limits), order_q(q, of_q, limits);
    const bool p_last = order_p >= order_q;
    const Candidate& last = p_last ? p : q;
    Candidate& other = p_last ? q : p;
    if (other.gap >= -limits.lip)
      choices.push_back({last.contact, order_p.ties_with(order_q, limits.pressed_in()), last.kept});
    drop(other);
  }
}

}  // namespace

void find_contacts(const Outline& a, const Outline& b, const PairLimits& limits,
                   std::span<const EarlierContact> earlier, std::span<const CoveredPart> covered,
                   FoundContacts& found) {
  assert(a.moved.cols() == a.vertices.cols() && std::ssize(a.sides.sides) == a.vertices.cols());
  assert(b.moved.cols() == b.vertices.cols() && std::ssize(b.sides.sides) == b.vertices.cols());
  assert(limits.search_margin >= 0 && limits.max_depth > 0 && limits.coincidence >= 0);
  thread_local Workspace work;
  auto &in_b = work.in_b, &in_a = work.in_a;
  Entrances{a, b, limits, earlier, covered, work.edges, work.at_vertex, found.choices}.find(in_b);
  Entrances{b, a, limits, earlier, covered, work.edges, work.at_vertex, found.choices}.find(in_a);
  for (Candidate& p : in_b)
    for (Candidate& q : in_a)
      if (!p.dropped && !q.dropped && share_corner(p, a, q, b, limits.search_margin))
        resolve_corner(p, a, q, b, limits, found.choices);
  for (const auto* candidates : {&in_b, &in_a})
    for (const Candidate& c : *candidates)
      if (!c.dropped) found.contacts.push_back(c.contact);
}

}  // namespace ddacontact
