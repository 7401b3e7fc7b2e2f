#include <ddacontact/detection/separation.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/directed_edge.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/triangulation.hpp>

#include <algorithm>
#include <cassert>
#include <limits>
#include <vector>

namespace ddacontact {

namespace {

/// The largest gap over the edges of `a` between the edge's line and the nearest vertex of `b`.
double largest_edge_gap(const PointsRef& a, const PointsRef& b) {
  double largest = -inf;
  for (Index j = 0; j < a.cols(); ++j) {
    const DirectedEdge edge(a, j);
    double gap = inf;
    for (Index i = 0; i < b.cols(); ++i) gap = std::min(gap, edge.gap(b.col(i)));
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

bool is_convex(const PointsRef& polygon) {
  const Index n = polygon.cols();
  for (Index k = 0; k < n; ++k)
    if (polyfem::orientation(polygon.col(k), polygon.col((k + 1) % n), polygon.col((k + 2) % n)) < 0)
      return false;
  return true;
}

/// The polygon itself where it is one.
std::vector<Points> convex_pieces(const PointsRef& polygon) {
  if (is_convex(polygon)) return {1, Points(polygon)};
  const polyfem::Triangles triangles = polyfem::triangulate(polygon);
  std::vector<Points> pieces;
  for (Index t = 0; t < triangles.cols(); ++t) pieces.push_back(polygon(Eigen::all, triangles.col(t)));
  return pieces;
}

}  // namespace

double separation(const PointsRef& a, const PointsRef& b) {
  assert(a.cols() >= 3 && b.cols() >= 3);
  if (is_convex(a) && is_convex(b)) return separation_of_convex(a, b);
  const std::vector<Points> of_a = convex_pieces(a), of_b = convex_pieces(b);
  double least = inf;
  for (const Points& p : of_a)
    for (const Points& q : of_b)
      if (least > 0 || touch(bounding_box(p), bounding_box(q)))
        least = std::min(least, separation_of_convex(p, q));
  return least;
}

}  // namespace ddacontact
