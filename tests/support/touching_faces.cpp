#include "touching_faces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace support {

namespace {

using polyfem::cross;
using polyfem::Index;

constexpr double relative_tolerance = 1e-7;

struct Box {
  Vec2 low, high;
  explicit Box(const Points& outline)
      : low(outline.rowwise().minCoeff()), high(outline.rowwise().maxCoeff()) {}
  double size() const { return (high - low).maxCoeff(); }
  bool is_near(const Box& other, double distance) const {
    return ((low - other.high).array() <= distance).all() && ((other.low - high).array() <= distance).all();
  }
};

Vec2 corner(const Points& outline, Index k) {
  return outline.col((k + outline.cols()) % outline.cols());
}

/// The edge from vertex k to k + 1 and places along it.
struct Edge {
  Vec2 from, direction;  ///< unit
  double length;
  Edge(const Points& outline, Index k) : from(outline.col(k)) {
    const Vec2 along = corner(outline, k + 1) - from;
    length = along.norm();
    direction = along / length;
  }
  double along(const Vec2& point) const { return direction.dot(point - from); }
  double distance(const Vec2& point) const { return cross(direction, point - from); }
  Vec2 inwards() const { return {-direction.y(), direction.x()}; }
};

/// The contacts of one pair of blocks.
class Pair {
 public:
  Pair(const std::vector<Points>& outlines, int one, int other, double tolerance)
      : one_(one),
        other_(other),
        tolerance_(tolerance),
        a_(outlines[static_cast<std::size_t>(one)]),
        b_(outlines[static_cast<std::size_t>(other)]) {}

  void find(Touching& found) {
    common_parts_of_edges();
    corners_on_edges(a_, b_, -1);
    corners_on_edges(b_, a_, 1);
    found.points.insert(found.points.end(), points_.begin(), points_.end());
    corners_on_corners(found.corners);
  }

 private:
  void add(const Vec2& at, const Vec2& normal) { points_.push_back({one_, other_, at, normal}); }
  bool is_known(const Vec2& at) const {
    return std::any_of(points_.begin(), points_.end(),
                       [&](const ContactPoint& point) { return (point.at - at).norm() <= tolerance_; });
  }

  void common_parts_of_edges() {
    for (Index i = 0; i < a_.cols(); ++i)
      for (Index j = 0; j < b_.cols(); ++j) {
        const Edge edge(a_, i);
        const Vec2 start = b_.col(j), end = corner(b_, j + 1);
        if (std::abs(edge.distance(start)) > tolerance_ || std::abs(edge.distance(end)) > tolerance_)
          continue;
        // The blocks lie on both sides of their common line where their edges run in opposite directions.
        const double from = std::max(0.0, edge.along(end)), to = std::min(edge.length, edge.along(start));
        if (to - from <= tolerance_) continue;
        for (const double point : {from, to}) add(edge.from + point * edge.direction, edge.inwards());
      }
  }

  /// \param[in] sense  1 when the corners are those of `other`
  void corners_on_edges(const Points& with_corners, const Points& with_edges, double sense) {
    for (Index k = 0; k < with_corners.cols(); ++k)
      for (Index e = 0; e < with_edges.cols(); ++e) {
        const Edge edge(with_edges, e);
        const Vec2 at = with_corners.col(k);
        const double along = edge.along(at);
        if (std::abs(edge.distance(at)) <= tolerance_ && along > tolerance_ &&
            along < edge.length - tolerance_ && !is_known(at))
          add(at, sense * edge.inwards());
      }
  }

  void corners_on_corners(std::vector<CornerContact>& corners) const {
    for (Index i = 0; i < a_.cols(); ++i)
      for (Index j = 0; j < b_.cols(); ++j) {
        const Vec2 at = a_.col(i);
        if ((b_.col(j) - at).norm() > tolerance_ || is_known(at)) continue;
        const Vec2 into_one[] = {corner(a_, i + 1) - at, corner(a_, i - 1) - at};
        const Vec2 into_other[] = {corner(b_, j + 1) - at, corner(b_, j - 1) - at};
        std::vector<Vec2> normals;  // of the separating lines along one of the edges
        for (const Vec2& edge : {into_one[0], into_one[1], into_other[0], into_other[1]})
          for (const double sense : {-1.0, 1.0}) {
            const Vec2 normal = sense * Vec2(-edge.y(), edge.x()).normalized();
            const auto leaves = [&](const Vec2& side, double of) {
              return of * normal.dot(side) >= -relative_tolerance * side.norm();
            };
            if (leaves(into_one[0], 1) && leaves(into_one[1], 1) && leaves(into_other[0], -1) &&
                leaves(into_other[1], -1))
              normals.push_back(normal);
          }
        if (normals.empty()) continue;
        const auto [first, last] = std::minmax_element(
            normals.begin(), normals.end(), [](const Vec2& a, const Vec2& b) { return cross(a, b) > 0; });
        corners.push_back({one_, other_, at, *first, *last});
      }
  }

  int one_, other_;
  double tolerance_;
  const Points &a_, &b_;
  std::vector<ContactPoint> points_;
};

}  // namespace

Touching touching_faces(const std::vector<Points>& outlines) {
  const std::vector<Box> boxes(outlines.begin(), outlines.end());
  Touching found;
  for (std::size_t i = 0; i < outlines.size(); ++i)
    for (std::size_t j = i + 1; j < outlines.size(); ++j) {
      const double tolerance = relative_tolerance * std::min(boxes[i].size(), boxes[j].size());
      if (boxes[i].is_near(boxes[j], tolerance))
        Pair(outlines, static_cast<int>(i), static_cast<int>(j), tolerance).find(found);
    }
  return found;
}

}  // namespace support
