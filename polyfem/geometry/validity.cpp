#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <limits>

namespace polyfem {
namespace {

std::optional<DefectiveVertex> find_repeated_vertex(const PointsRef& polygon) {
  const int n = static_cast<int>(polygon.cols());
  for (int i = 0; i < n; ++i)
    for (int j = i + 1; j < n; ++j)
      if (polygon.col(i) == polygon.col(j)) return DefectiveVertex{PolygonDefect::repeated_vertex, i, j};
  return std::nullopt;
}

bool all_collinear(const PointsRef& polygon) {
  for (Index k = 2; k < polygon.cols(); ++k)
    if (orientation(polygon.col(0), polygon.col(1), polygon.col(k)) != 0) return false;
  return true;
}

/// Needs vertices that differ. Neighbouring edges that fold back onto each other need no test of their own:
/// the end of the shorter one lies on the longer, so the edge behind it meets the longer one too.
std::optional<DefectiveVertex> find_self_intersection(const PointsRef& polygon) {
  const int n = static_cast<int>(polygon.cols());
  const auto vertex = [&](int i) -> Vec2 { return polygon.col(i % n); };
  for (int i = 0; i < n; ++i) {
    const int last = i == 0 ? n - 1 : n;  // edge n - 1 is a neighbour of edge 0
    for (int j = i + 2; j < last; ++j)
      if (segments_intersect(vertex(i), vertex(i + 1), vertex(j), vertex(j + 1)))
        return DefectiveVertex{PolygonDefect::self_intersection, i, j};
  }
  return std::nullopt;
}

/// The reason and the cure.
std::string complaint(const DefectiveVertex& found) {
  const std::string vertex = "vertex " + std::to_string(found.vertex), other = std::to_string(found.other);
  switch (found.defect) {
    case PolygonDefect::too_few_vertices:
      return "has fewer than three vertices: give it three at least";
    case PolygonDefect::not_finite:
      return vertex + " is nowhere: give it finite coordinates";
    case PolygonDefect::repeated_vertex:
      return vertex + " and vertex " + other + " are at the same place: leave one out";
    case PolygonDefect::zero_area:
      return vertex + " and all others lie on one line: move a vertex";
    case PolygonDefect::self_intersection:
      break;
  }
  return "the edge from " + vertex + " meets that from vertex " + other +
         ": give the vertices in their order along the outline";
}

}  // namespace

std::optional<DefectiveVertex> find_defect(const PointsRef& polygon) {
  const int n = static_cast<int>(polygon.cols());
  if (n < 3) return DefectiveVertex{PolygonDefect::too_few_vertices, 0, 0};
  for (int i = 0; i < n; ++i)
    if (!polygon.col(i).allFinite()) return DefectiveVertex{PolygonDefect::not_finite, i, i};
  if (const auto repeated = find_repeated_vertex(polygon)) return repeated;
  if (all_collinear(polygon)) return DefectiveVertex{PolygonDefect::zero_area, 0, 0};
  return find_self_intersection(polygon);
}

void require_usable(const PointsRef& polygon) {
  if (const auto defect = find_defect(polygon)) throw Error("polygon: " + complaint(*defect));
  if (!(signed_area(polygon) > 0))
    throw Error("polygon: runs clockwise from vertex 0 on: reverse its vertices");
}

std::optional<int> find_non_convex_corner(const PointsRef& polygon, double min_turn) {
  const int n = static_cast<int>(polygon.cols());
  for (int i = 0; i < n; ++i) {
    const Vec2 before = polygon.col((i + n - 1) % n), corner = polygon.col(i),
               after = polygon.col((i + 1) % n);
    if (orientation(before, corner, after) <= 0) return i;
    const Vec2 in = corner - before, out = after - corner;
    if (min_turn > 0 && in.dot(out) > 0 && cross(in, out) <= min_turn * in.norm() * out.norm()) return i;
  }
  return std::nullopt;
}

bool contains(const PointsRef& polygon, const Vec2& x) {
  const Index n = polygon.cols();
  bool inside = false;  // the parity of the edges crossed by the ray from x to the right
  for (Index k = 0; k < n; ++k) {
    const Vec2 a = polygon.col(k), b = polygon.col((k + 1) % n);
    if (on_segment(a, b, x)) return true;
    const bool upward = a.y() <= x.y() && x.y() < b.y(), downward = b.y() <= x.y() && x.y() < a.y();
    const int side = orientation(a, b, x);
    if ((upward && side > 0) || (downward && side < 0)) inside = !inside;
  }
  return inside;
}

double distance_outside(const PointsRef& polygon, const Vec2& x) {
  if (contains(polygon, x)) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 start = polygon.col(k), edge = polygon.col((k + 1) % polygon.cols()) - start;
    const double along = std::clamp(edge.dot(x - start) / edge.squaredNorm(), 0.0, 1.0);
    nearest = std::min(nearest, (start + along * edge - x).norm());
  }
  return nearest;
}

}  // namespace polyfem
