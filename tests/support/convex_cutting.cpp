#include "convex_cutting.hpp"

#include <polyfem/geometry/area_moments.hpp>

#include <cmath>
#include <utility>

namespace support {

namespace {

using polyfem::cross;
using polyfem::Index;

/// Where the line crosses the edge between two points on different sides of it, whichever comes first.
Vec2 crossing(Vec2 a, Vec2 b, const Line& line) {
  if (std::pair(b.x(), b.y()) < std::pair(a.x(), a.y())) std::swap(a, b);
  const double at_a = line.left(a), at_b = line.left(b);
  return a + at_a / (at_a - at_b) * (b - a);
}

Line reversed(const Line& line) {
  return {line.through, -line.direction};
}

}  // namespace

bool is_sliver(const Points& polygon, const Sliver& sliver) {
  const Index n = polygon.cols();
  if (n < 3 || polyfem::signed_area(polygon) < sliver.area) return true;
  for (Index k = 0; k < n; ++k) {
    const Vec2 forth = polygon.col((k + 1) % n) - polygon.col(k),
               back = polygon.col((k + n - 1) % n) - polygon.col(k);
    if (std::atan2(cross(forth, back), forth.dot(back)) < sliver.angle) return true;
  }
  return false;
}

Points left_of(const Points& polygon, const Line& line) {
  std::vector<Vec2> kept;
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Vec2 from = polygon.col(k), to = polygon.col((k + 1) % polygon.cols());
    const double at_from = line.left(from), at_to = line.left(to);
    if (at_from >= 0) kept.push_back(from);
    if ((at_from > 0 && at_to < 0) || (at_from < 0 && at_to > 0)) kept.push_back(crossing(from, to, line));
  }
  if (kept.size() < 3) return Points(2, 0);
  Points part(2, static_cast<Index>(kept.size()));
  for (std::size_t k = 0; k < kept.size(); ++k) part.col(static_cast<Index>(k)) = kept[k];
  return part;
}

std::vector<Points> cut(const std::vector<Points>& polygons, const Line& line, const Sliver& sliver) {
  std::vector<Points> pieces;
  for (const Points& polygon : polygons) {
    const Points left = left_of(polygon, line), right = left_of(polygon, reversed(line));
    if (is_sliver(left, sliver) || is_sliver(right, sliver)) {
      pieces.push_back(polygon);
    } else {
      pieces.push_back(left);
      pieces.push_back(right);
    }
  }
  return pieces;
}

void merge_vertices(std::vector<Points>& polygons, double distance) {
  std::vector<Vec2> known;
  for (Points& polygon : polygons)
    for (Index k = 0; k < polygon.cols(); ++k) {
      bool found = false;
      for (const Vec2& vertex : known) {
        if ((vertex - polygon.col(k)).cwiseAbs().maxCoeff() > distance) continue;
        polygon.col(k) = vertex;
        found = true;
        break;
      }
      if (!found) known.push_back(polygon.col(k));
    }
}

}  // namespace support
