#include <ddacontact/detection/separation.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace ddacontact {

using polyfem::Index;
using polyfem::Points;

namespace {

/// The largest gap over the edges of `a` between the edge's line and the nearest vertex of `b`.
double largest_edge_gap(const PointsRef& a, const PointsRef& b) {
  double largest = -std::numeric_limits<double>::infinity();
  for (Index j = 0; j < a.cols(); ++j) {
    const Vec2 origin = a.col(j);
    const Vec2 edge = a.col((j + 1) % a.cols()) - origin;
    const Vec2 normal = Vec2(edge.y(), -edge.x()) / edge.norm();
    double gap = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < b.cols(); ++i) gap = std::min(gap, normal.dot(b.col(i) - origin));
    largest = std::max(largest, gap);
  }
  return largest;
}

/// Whether the line of an edge of `a` has all of `b` on its outer side or on itself. Exact.
bool has_dividing_edge(const PointsRef& a, const PointsRef& b) {
  for (Index j = 0; j < a.cols(); ++j) {
    const Vec2 from = a.col(j), to = a.col((j + 1) % a.cols());
    Index i = 0;
    while (i < b.cols() && polyfem::orientation(from, to, b.col(i)) <= 0) ++i;
    if (i == b.cols()) return true;
  }
  return false;
}

/// Of convex polygons, straight corners allowed.
double separation_of_convex(const PointsRef& a, const PointsRef& b) {
  const double gap = std::max(largest_edge_gap(a, b), largest_edge_gap(b, a));
  if (has_dividing_edge(a, b) || has_dividing_edge(b, a)) return std::max(gap, 0.0);
  return std::min(gap, -std::numeric_limits<double>::min());
}

struct Piece {
  Points outline;
  Box box;
};

std::vector<Piece> convex_pieces(const PointsRef& polygon) {
  const polyfem::Triangles triangles = polyfem::triangulate(polygon);
  std::vector<Piece> pieces;
  for (Index t = 0; t < triangles.cols(); ++t) {
    Points triangle(2, 3);
    for (Index k = 0; k < 3; ++k) triangle.col(k) = polygon.col(triangles(k, t));
    pieces.push_back({triangle, bounding_box(triangle)});
  }
  return pieces;
}

bool is_convex(const PointsRef& polygon) {
  const Index n = polygon.cols();
  for (Index k = 0; k < n; ++k)
    if (polyfem::orientation(polygon.col(k), polygon.col((k + 1) % n), polygon.col((k + 2) % n)) < 0)
      return false;
  return true;
}

}  // namespace

double separation(const PointsRef& a, const PointsRef& b) {
  const bool a_convex = is_convex(a), b_convex = is_convex(b);
  if (a_convex && b_convex) return separation_of_convex(a, b);
  const std::vector<Piece> of_a = a_convex ? std::vector<Piece>{{a, bounding_box(a)}} : convex_pieces(a),
                           of_b = b_convex ? std::vector<Piece>{{b, bounding_box(b)}} : convex_pieces(b);
  double least = std::numeric_limits<double>::infinity();
  for (const Piece& p : of_a)
    for (const Piece& q : of_b) {
      const bool apart =
          (p.box.low.array() > q.box.high.array()).any() || (q.box.low.array() > p.box.high.array()).any();
      if (apart && least <= 0) continue;
      least = std::min(least, separation_of_convex(p.outline, q.outline));
    }
  return least;
}

}  // namespace ddacontact
