#include <ddacontact/detection/corner.hpp>

#include <cassert>
#include <cmath>
#include <numbers>

namespace ddacontact {

/// A little more than half a turn: two sides of a plate look away from each other.
constexpr double largest_turn = std::numbers::pi + 0.1;

Corner turn_between(const Vec2& before, const Vec2& after) {
  const double sine = cross(before, after), cosine = before.dot(after);
  if (cosine > 0 && sine * sine <= sin_parallel * sin_parallel * before.squaredNorm() * after.squaredNorm())
    return Corner::straight;
  return sine < 0 ? Corner::reflex : Corner::convex;
}

Corner corner_at(const PointsRef& polygon, int vertex) {
  assert(vertex >= 0 && vertex < polygon.cols());
  return turn_between(along(polygon, previous(vertex, polygon)), along(polygon, vertex));
}

/// Whether all corners between these edges pass a test of the edges before and after them.
static bool all_corners(const PointsRef& polygon, int from, int to, const auto& passes) {
  for (int e = from; e != to; e = next(e, polygon))
    if (!passes(along(polygon, e), along(polygon, next(e, polygon)))) return false;
  return true;
}

bool are_collinear(const PointsRef& polygon, int from, int to) {
  return all_corners(polygon, from, to, [first = along(polygon, from)](const Vec2& before, const Vec2& now) {
    return turn_between(before, now) == Corner::straight && turn_between(first, now) == Corner::straight;
  });
}

bool turns_left(const PointsRef& polygon, int from, int to) {
  double turn = 0;
  return all_corners(polygon, from, to, [&](const Vec2& before, const Vec2& now) {
    turn += std::atan2(cross(before, now), before.dot(now));
    return turn_between(before, now) != Corner::reflex && turn <= largest_turn;
  });
}

double straight_length(const PointsRef& polygon, int edge, bool forth) {
  const auto step = [&](int e) { return forth ? next(e, polygon) : previous(e, polygon); };
  double length = 0;
  for (int e = step(edge); e != edge; e = step(e)) {
    const int first = forth ? edge : e, last = forth ? e : edge;
    if (corner_at(polygon, forth ? e : next(e, polygon)) != Corner::straight ||
        turn_between(along(polygon, first), along(polygon, last)) != Corner::straight)
      break;
    length += along(polygon, e).norm();
  }
  return length;
}

}  // namespace ddacontact
