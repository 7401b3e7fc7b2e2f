#include <ddacontact/detection/narrow_phase.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace ddacontact {

namespace {

/// Edges within 3 degrees of each other count as touching along their length.
constexpr double sin_parallel = 0.0523;

int next(int k, const PointsRef& polygon) {
  return k + 1 == polygon.cols() ? 0 : k + 1;
}
int previous(int k, const PointsRef& polygon) {
  return (k == 0 ? static_cast<int>(polygon.cols()) : k) - 1;
}

struct Edge {
  Vec2 start, tangent, normal;  // outward normal of a counter-clockwise polygon
  double length;

  Edge(const PointsRef& polygon, int edge) : start(polygon.col(edge)) {
    const Vec2 along = polygon.col(next(edge, polygon)) - start;
    length = along.norm();
    tangent = along / length;
    normal = Vec2(tangent.y(), -tangent.x());
  }
  double gap(const Vec2& x) const { return normal.dot(x - start); }
  /// How far the projection of x lies beyond the nearer end; <= 0 within the edge.
  double overshoot(const Vec2& x) const {
    const double s = tangent.dot(x - start);
    return std::max(-s, s - length);
  }
};

/// Whether the corner at `vertex` lies on the outer side of an edge with this normal, or may be turned there
/// within the step.
bool admissible(const PointsRef& polygon, int vertex, const Vec2& normal, double reach) {
  const Vec2 x = polygon.col(vertex);
  for (int neighbour : {next(vertex, polygon), previous(vertex, polygon)}) {
    const Vec2 side = polygon.col(neighbour) - x;
    const double length = side.norm();
    if (normal.dot(side) < -std::max(sin_parallel * length, std::min(reach, length / 2))) return false;
  }
  return true;
}

struct Candidate {
  VertexEdge contact;
  double gap, overshoot;
  Vec2 normal;
  bool kept;
  bool strict;  ///< admissible as it stands, without turning within the step
  bool dropped = false;

  bool inside() const { return overshoot <= 0; }
};

bool is_kept(std::span<const VertexEdge> kept, const VertexEdge& contact) {
  return std::find(kept.begin(), kept.end(), contact) != kept.end();
}

/// Whether x lies beyond some edge by more than `tolerance`.
bool is_outside(const PointsRef& polygon, const Vec2& x, double tolerance) {
  for (int e = 0; e < polygon.cols(); ++e)
    if (Edge(polygon, e).gap(x) > tolerance) return true;
  return false;
}

/// The entrance edge of each vertex of `a` into `b`.
void add_entrances(const Outline& a, const Outline& b, const PairLimits& limits,
                   std::span<const VertexEdge> kept, std::vector<Candidate>& candidates) {
  for (int i = 0; i < a.vertices.cols(); ++i) {
    const Vec2 x = a.vertices.col(i);
    const bool outside = is_outside(b.vertices, x, limits.coincidence);
    std::optional<Candidate> best;
    for (int e = 0; e < b.vertices.cols(); ++e) {
      const Edge edge(b.vertices, e);
      const double gap = edge.gap(x), overshoot = edge.overshoot(x);
      const double aside = std::max(overshoot, 0.0), off = aside > 0 ? gap : std::max(gap, 0.0);
      if (gap < -limits.max_depth || std::hypot(off, aside) > limits.reach) continue;
      if (gap < -limits.coincidence && outside) continue;
      if (!admissible(a.vertices, i, edge.normal, limits.reach)) continue;
      const VertexEdge contact{a.block, i, b.block, e};
      const bool stays = overshoot <= limits.coincidence && is_kept(kept, contact);
      if (best && std::pair(best->kept, best->gap) >= std::pair(stays, gap)) continue;
      const bool strict = admissible(a.vertices, i, edge.normal, 0);
      best = Candidate{contact, gap, overshoot, edge.normal, stays, strict};
    }
    if (best) candidates.push_back(*best);
  }
}

/// The end of an edge that is nearer to x.
int nearer_end(const PointsRef& polygon, int edge, const Vec2& x) {
  const int end = next(edge, polygon);
  return (polygon.col(edge) - x).squaredNorm() <= (polygon.col(end) - x).squaredNorm() ? edge : end;
}

/// Whether the two contacts are between the same two corners: each one's vertex is the near end of the
/// other's edge.
bool share_corner(const Candidate& p, const Outline& a, const Candidate& q, const Outline& b, double reach) {
  const int i = p.contact.vertex, j = q.contact.vertex;
  const Vec2 x_i = a.vertices.col(i), x_j = b.vertices.col(j);
  return nearer_end(b.vertices, p.contact.edge, x_i) == j &&
         nearer_end(a.vertices, q.contact.edge, x_j) == i && (x_i - x_j).norm() <= reach;
}

/// Vertex on vertex: decides which of the two stays, or both as the two ends of a short overlap.
void resolve_corner(Candidate& p, const Outline& a, Candidate& q, const Outline& b,
                    const PairLimits& limits) {
  const bool parallel = p.normal.dot(q.normal) < 0 && std::abs(cross(p.normal, q.normal)) <= sin_parallel;
  if (p.kept != q.kept) {
    // Both may stay only as the two ends of one overlap.
    Candidate& other = p.kept ? q : p;
    const Vec2 distance = a.vertices.col(p.contact.vertex) - b.vertices.col(q.contact.vertex);
    if (!parallel || !other.inside() || std::abs(cross(p.normal, distance)) <= limits.coincidence)
      other.dropped = true;
    return;
  }
  if (!parallel && p.strict != q.strict) {
    // One is an entrance only if its corner turns within the step: it may wait for that, open.
    Candidate& loose = p.strict ? q : p;
    loose.dropped = loose.gap <= 0;
  } else if (!parallel) {
    (p.gap >= q.gap ? q : p).dropped = true;
  } else if (p.inside() != q.inside()) {
    (p.inside() ? q : p).dropped = true;
  } else {
    const Vec2 distance = a.vertices.col(p.contact.vertex) - b.vertices.col(q.contact.vertex);
    const bool one_place = std::abs(cross(p.normal, distance)) <= limits.coincidence;
    if (!p.inside() || (one_place && !p.kept)) q.dropped = true;
  }
}

}  // namespace

void find_contacts(const Outline& a, const Outline& b, const PairLimits& limits,
                   std::span<const VertexEdge> kept, std::vector<VertexEdge>& contacts) {
  std::vector<Candidate> of_a, of_b;
  add_entrances(a, b, limits, kept, of_a);
  add_entrances(b, a, limits, kept, of_b);
  for (Candidate& p : of_a)
    for (Candidate& q : of_b)
      if (!p.dropped && !q.dropped && share_corner(p, a, q, b, limits.reach))
        resolve_corner(p, a, q, b, limits);
  for (const auto* candidates : {&of_a, &of_b})
    for (const Candidate& c : *candidates)
      if (!c.dropped) contacts.push_back(c.contact);
}

double contact_length(const PointsRef& vertex_polygon, int vertex, const PointsRef& edge_polygon, int edge) {
  const Edge e(edge_polygon, edge);
  const Vec2 x = vertex_polygon.col(vertex);
  double length = 0;
  for (int neighbour : {next(vertex, vertex_polygon), previous(vertex, vertex_polygon)}) {
    const Vec2 y = vertex_polygon.col(neighbour);
    if (std::abs(e.normal.dot(y - x)) > sin_parallel * (y - x).norm()) continue;
    const double s = e.tangent.dot(x - e.start), t = e.tangent.dot(y - e.start);
    const double overlap = std::min(std::max(s, t), e.length) - std::max(std::min(s, t), 0.0);
    length = std::max(length, overlap / 2);
  }
  return length;
}

}  // namespace ddacontact
