#include <polyfem/core/error.hpp>
#include <polyfem/geometry/predicates.hpp>
#include <polyfem/geometry/triangulation.hpp>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

namespace polyfem {
namespace {

/// The least of |sin| over the corners of a triangle: its smallest angle's, as the largest angle's is larger.
double smallest_sine(const Vec2& a, const Vec2& b, const Vec2& c) {
  const double ab = (b - a).norm(), bc = (c - b).norm(), ca = (a - c).norm();
  return cross(b - a, c - a) * std::min({ab, bc, ca}) / (ab * bc * ca);
}

/// What is left of the polygon.
class Remainder {
 public:
  explicit Remainder(const PointsRef& polygon)
      : polygon_(polygon), left_(static_cast<std::size_t>(polygon.cols())) {
    std::iota(left_.begin(), left_.end(), 0);
  }

  /// Cuts off the best ear and returns it.
  Eigen::Vector3i cut_ear() {
    const std::size_t n = left_.size();
    order_.resize(n);
    sines_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      order_[i] = i;
      const Eigen::Vector3i t = corner(i);
      sines_[i] = smallest_sine(vertex(t[0]), vertex(t[1]), vertex(t[2]));
    }
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t i, std::size_t j) { return sines_[i] > sines_[j]; });
    for (const std::size_t i : order_) {
      const Eigen::Vector3i ear = corner(i);
      if (!is_ear(ear)) continue;
      left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
      return ear;
    }
    throw Error("triangulate: no ear left, the polygon is not simple or not counter-clockwise");
  }

 private:
  Vec2 vertex(int i) const { return polygon_.col(i); }
  Eigen::Vector3i corner(std::size_t i) const {
    const std::size_t n = left_.size();
    return {left_[(i + n - 1) % n], left_[i], left_[(i + 1) % n]};
  }
  /// The closed triangle must contain no other vertex: then what is left is simple again, and as simple
  /// polygons have ears of positive area, so has it.
  bool is_ear(const Eigen::Vector3i& t) const {
    const Vec2 a = vertex(t[0]), b = vertex(t[1]), c = vertex(t[2]);
    if (orientation(a, b, c) <= 0) return false;
    return std::none_of(left_.begin(), left_.end(), [&](int i) {
      const Vec2 x = vertex(i);
      return i != t[0] && i != t[1] && i != t[2] && orientation(a, b, x) >= 0 && orientation(b, c, x) >= 0 &&
             orientation(c, a, x) >= 0;
    });
  }

  PointsRef polygon_;
  std::vector<int> left_;
  std::vector<std::size_t> order_;
  std::vector<double> sines_;
};

}  // namespace

Triangles triangulate(const PointsRef& polygon) {
  if (polygon.cols() < 3)
    throw Error("triangulate: a polygon of " + std::to_string(polygon.cols()) +
                " vertices has no area: give it three at least");
  Triangles triangles(3, polygon.cols() - 2);
  Remainder remainder(polygon);
  for (Index k = 0; k < triangles.cols(); ++k) triangles.col(k) = remainder.cut_ear();
  return triangles;
}

}  // namespace polyfem
