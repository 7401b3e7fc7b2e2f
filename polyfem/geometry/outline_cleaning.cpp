#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/outline_cleaning.hpp>
#include <polyfem/geometry/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace polyfem {
namespace {

Points points_of(const std::vector<Vec2>& vertices) {
  Points points(2, static_cast<Index>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k) points.col(static_cast<Index>(k)) = vertices[k];
  return points;
}

/// A polygon that stays simple and counter-clockwise while vertices are taken out.
class Outline {
 public:
  explicit Outline(const PointsRef& polygon) {
    for (Index k = 0; k < polygon.cols(); ++k) {
      vertices_.emplace_back(polygon.col(k));
      sources_.push_back({static_cast<int>(k)});
    }
  }

  int n() const { return static_cast<int>(vertices_.size()); }
  const Vec2& vertex(int k) const { return vertices_[index(k)]; }
  const std::vector<int>& sources(int k) const { return sources_[index(k)]; }
  double length(int edge) const { return (vertex(edge + 1) - vertex(edge)).norm(); }

  /// Takes vertex k out; returns false and changes nothing where that would break the polygon.
  bool drop(int k) {
    std::vector<Vec2> rest = vertices_;
    rest.erase(rest.begin() + k);
    if (!is_valid(rest, {k - 1})) return false;
    vertices_ = std::move(rest);
    sources_.erase(sources_.begin() + k);
    return true;
  }

  /// Makes one vertex at `position` of the two ends of an edge, or changes nothing.
  bool merge(int edge, const Vec2& position) {
    const int k = edge, next = index(edge + 1);
    std::vector<Vec2> rest = vertices_;
    rest[k] = position;
    rest.erase(rest.begin() + next);
    const int merged = next == 0 ? k - 1 : k;
    if (!is_valid(rest, {merged - 1, merged})) return false;
    vertices_ = std::move(rest);
    sources_[k].insert(sources_[k].end(), sources_[next].begin(), sources_[next].end());
    std::sort(sources_[k].begin(), sources_[k].end());
    sources_.erase(sources_.begin() + next);
    return true;
  }

  CleanedOutline cleaned(int n_before) const { return {points_of(vertices_), sources_, n_before - n()}; }

 private:
  int index(int k) const { return (k + n()) % n(); }

  /// Whether a polygon is simple and counter-clockwise, of which all but the `changed` edges are known to be
  /// those of such a one.
  static bool is_valid(const std::vector<Vec2>& polygon, std::initializer_list<int> changed) {
    if (polygon.size() < 3) return false;
    for (const int edge : changed)
      if (!is_free(polygon, edge)) return false;
    return signed_area(points_of(polygon)) > 0;
  }

  /// Whether an edge has a length and no point in common with others but its ends with its neighbours.
  static bool is_free(const std::vector<Vec2>& polygon, int edge) {
    const int n = static_cast<int>(polygon.size());
    const auto at = [&](int k) { return polygon[static_cast<std::size_t>((k + 2 * n) % n)]; };
    const Vec2 a = at(edge), b = at(edge + 1);
    if (a == b || on_segment(a, b, at(edge + 2)) || on_segment(a, b, at(edge - 1)) ||
        on_segment(b, at(edge + 2), a) || on_segment(at(edge - 1), a, b))
      return false;
    for (int other = edge + 2; other < edge + n - 1; ++other)
      if (segments_intersect(a, b, at(other), at(other + 1))) return false;
    return true;
  }

  std::vector<Vec2> vertices_;
  std::vector<std::vector<int>> sources_;
};

/// 0 on a straight line, exactly; 1 when it turns by a right angle or more.
double bend(const Outline& outline, int k) {
  const Vec2 &before = outline.vertex(k - 1), &here = outline.vertex(k), &after = outline.vertex(k + 1);
  if ((here - before).dot(after - here) <= 0) return 1;
  return orientation(before, here, after) == 0 ? 0 : std::abs(turn_sine(before, here, after));
}

/// The first index with the least measure, if that is at most `limit`; else -1.
template <class Measure>
int find_least(int n, double limit, const Measure& measure) {
  int least = -1;
  double of_least = limit;
  for (int k = 0; k < n; ++k) {
    const double value = measure(k);
    if (value > of_least || (value == of_least && least >= 0)) continue;
    least = k;
    of_least = value;
  }
  return least;
}

}  // namespace

CleanedOutline drop_straight_vertices(const PointsRef& polygon, double least_turn) {
  Outline outline(polygon);
  std::vector<bool> stays(static_cast<std::size_t>(polygon.cols()), false);
  const auto measure = [&](int k) {
    return stays[outline.sources(k).front()] ? std::numeric_limits<double>::infinity() : bend(outline, k);
  };
  for (int k; (k = find_least(outline.n(), least_turn, measure)) >= 0;) {
    const int source = outline.sources(k).front();
    if (!outline.drop(k)) stays[source] = true;
  }
  return outline.cleaned(static_cast<int>(polygon.cols()));
}

CleanedOutline merge_ends_of_short_edges(const PointsRef& polygon, double shortest) {
  Outline outline(polygon);
  // Edges that cannot go, by the first source of the vertex they start from.
  std::vector<bool> stays(static_cast<std::size_t>(polygon.cols()), false);
  const auto measure = [&](int k) {
    const double length = outline.length(k);
    return stays[outline.sources(k).front()] || length >= shortest ? std::numeric_limits<double>::infinity()
                                                                   : length;
  };
  for (int k; (k = find_least(outline.n(), shortest, measure)) >= 0;) {
    const int source = outline.sources(k).front();
    const Vec2 a = outline.vertex(k), b = outline.vertex(k + 1);
    if (!outline.merge(k, (a + b) / 2) && !outline.merge(k, a) && !outline.merge(k, b)) stays[source] = true;
  }
  return outline.cleaned(static_cast<int>(polygon.cols()));
}

}  // namespace polyfem
