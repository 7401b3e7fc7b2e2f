#include <polyfem/mesh/outline_snapping.hpp>

#include <polyfem/mesh/segment_grid.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>

namespace polyfem {

namespace {

/// Positions that several vertices share.
class SharedPoints {
 public:
  explicit SharedPoints(double distance) : distance_(distance) {}

  const std::vector<Vec2>& positions() const { return positions_; }
  /// Number of the first position within the distance; a new one where there is none.
  int number(const Vec2& point) {
    const Square at{std::llround(point.x() / distance_), std::llround(point.y() / distance_)};
    for (std::int64_t dx = -1; dx <= 1; ++dx)
      for (std::int64_t dy = -1; dy <= 1; ++dy)
        for (const int k : squares_[{at[0] + dx, at[1] + dy}])
          if ((positions_[k] - point).norm() <= distance_) return k;
    squares_[at].push_back(static_cast<int>(positions_.size()));
    positions_.push_back(point);
    return static_cast<int>(positions_.size()) - 1;
  }

 private:
  using Square = std::array<std::int64_t, 2>;
  double distance_;
  std::vector<Vec2> positions_;
  std::map<Square, std::vector<int>> squares_;
};

using Edge = std::pair<int, int>;

std::vector<Edge> edges_of(const std::vector<std::vector<int>>& polygons) {
  std::set<Edge> edges;
  for (const std::vector<int>& corners : polygons)
    for (std::size_t k = 0; k < corners.size(); ++k)
      edges.insert(std::minmax(corners[k], corners[(k + 1) % corners.size()]));
  return {edges.begin(), edges.end()};
}

/// Moves positions onto edges that they are near and no ends of. Whether any was moved.
bool move_onto_edges(std::vector<Vec2>& positions, const std::vector<Edge>& edges, double distance) {
  std::vector<Segment> segments;
  for (const auto& [from, to] : edges) segments.push_back({positions[from], positions[to], 0});
  const SegmentGrid index(segments, static_cast<double>(segments.size()));
  const double on_it = 1e-9 * distance;
  bool moved = false;
  for (int p = 0; p < static_cast<int>(positions.size()); ++p) {
    std::set<int> nearby;
    for (const double dx : {-distance, 0.0, distance})
      for (const double dy : {-distance, 0.0, distance})
        for (const int e : index.near(positions[p] + Vec2(dx, dy))) nearby.insert(e);
    Vec2 target = positions[p];
    double least = distance;
    for (const int e : nearby) {
      const auto [from, to] = edges[e];
      if (from == p || to == p) continue;
      const Vec2 along = positions[to] - positions[from], arm = positions[p] - positions[from];
      const double t = along.dot(arm) / along.squaredNorm();
      const Vec2 foot = positions[from] + t * along;
      const double away = (foot - positions[p]).norm();
      if (t <= 0 || t >= 1 || away >= least) continue;
      least = away;
      target = foot;
    }
    moved = moved || (target - positions[p]).norm() > on_it;
    positions[p] = target;
  }
  return moved;
}

}  // namespace

Snapping snap_outlines(std::vector<Points>& outlines, double distance) {
  Snapping result;
  SharedPoints shared(distance);
  std::vector<std::vector<int>> polygons;
  for (const Points& outline : outlines) {
    std::vector<int>& corners = polygons.emplace_back();
    for (Index k = 0; k < outline.cols(); ++k) corners.push_back(shared.number(outline.col(k)));
    std::vector<int> sorted = corners;
    std::ranges::sort(sorted);
    if (std::ranges::adjacent_find(sorted) != sorted.end()) {
      result.collapsed = static_cast<int>(polygons.size()) - 1;
      return result;
    }
  }
  std::vector<Vec2> positions = shared.positions();
  const std::vector<Edge> edges = edges_of(polygons);
  constexpr int most_rounds = 8;  // each moves edges that others lie on
  for (int round = 0; round < most_rounds && move_onto_edges(positions, edges, distance); ++round) {
  }
  for (std::size_t p = 0; p < polygons.size(); ++p)
    for (std::size_t k = 0; k < polygons[p].size(); ++k) {
      const double by = (positions[polygons[p][k]] - outlines[p].col(static_cast<Index>(k))).norm();
      result.n_moved += by > 0;
      result.farthest = std::max(result.farthest, by);
      outlines[p].col(static_cast<Index>(k)) = positions[polygons[p][k]];
    }
  return result;
}

}  // namespace polyfem
