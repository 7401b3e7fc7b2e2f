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

bool are_collinear(const PointsRef& polygon, int from, int to) {
  const Vec2 first = along(polygon, from);
  for (int e = from; e != to;) {
    const Vec2 before = along(polygon, e);
    e = next(e, polygon);
    const Vec2 now = along(polygon, e);
    if (turn_between(before, now) != Corner::straight || turn_between(first, now) != Corner::straight)
      return false;
  }
  return true;
}

bool turns_left(const PointsRef& polygon, int from, int to) {
  double turn = 0;
  for (int e = from; e != to;) {
    const Vec2 before = along(polygon, e);
    e = next(e, polygon);
    const Vec2 now = along(polygon, e);
    if (turn_between(before, now) == Corner::reflex) return false;
    turn += std::atan2(cross(before, now), before.dot(now));
    if (turn > largest_turn) return false;
  }
  return true;
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
