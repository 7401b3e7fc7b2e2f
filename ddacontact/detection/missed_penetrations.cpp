#include <ddacontact/detection/missed_penetrations.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/directed_edge.hpp>
#include <polyfem/geometry/validity.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

struct Path {
  Vec2 start, end;

  Vec2 at(double t) const { return start + t * (end - start); }
};

bool goes_through(const Path& x, const Path& from, const Path& to, double tolerance) {
  const auto edge = [&](double t) { return DirectedEdge(from.at(t), to.at(t)); };
  const auto is_behind = [&](double t) { return edge(t).gap(x.at(t)) < -tolerance; };
  double outside = 0, behind = 1;
  if (is_behind(outside) || !is_behind(behind) || edge(behind).overshoot(x.end) > 0) return false;
  for (int k = 0; k < std::numeric_limits<double>::digits; ++k) {
    const double middle = (outside + behind) / 2;
    (is_behind(middle) ? behind : outside) = middle;
  }
  return edge(outside).overshoot(x.at(outside)) <= tolerance;
}

bool is_deep_in(const PointsRef& polygon, const Vec2& x, double tolerance) {
  if (!polyfem::contains(polygon, x)) return false;
  for (int e = 0; e < polygon.cols(); ++e) {
    const DirectedEdge edge(polygon, e);
    if (std::hypot(edge.gap(x), std::max(edge.overshoot(x), 0.0)) <= tolerance) return false;
  }
  return true;
}

Box swept_box(const MovingOutline& outline) {
  return joined(bounding_box(outline.start), bounding_box(outline.end));
}

/// Of vertices that come into a box.
void find_entries_of(const MovingOutline& a, const MovingOutline& b, const Box& box, double tolerance,
                     std::vector<VertexEdge>& entries) {
  const auto path = [](const MovingOutline& of, int k) -> Path { return {of.start.col(k), of.end.col(k)}; };
  for (int i = 0; i < a.start.cols(); ++i) {
    const Path x = path(a, i);
    if (!touch({x.start.cwiseMin(x.end), x.start.cwiseMax(x.end)}, box) ||
        corner_at(a.start, i) == Corner::reflex)
      continue;
    for (int e = 0; e < b.start.cols(); ++e)
      if (goes_through(x, path(b, e), path(b, next(e, b.start)), tolerance) &&
          is_deep_in(b.end, x.end, tolerance))
        entries.push_back({a.block, i, b.block, e});
  }
}

}  // namespace

void find_missed_penetrations(const MovingOutline& a, const MovingOutline& b, double tolerance,
                              std::vector<VertexEdge>& entries) {
  const Box of_a = swept_box(a), of_b = swept_box(b);
  if (!touch(of_a, of_b)) return;
  find_entries_of(a, b, of_b, tolerance, entries);
  find_entries_of(b, a, of_a, tolerance, entries);
}

}  // namespace ddacontact
