#include <polyfem/geometry/diagonals.hpp>
#include <polyfem/geometry/predicates.hpp>

#include <algorithm>

namespace polyfem {
namespace {

/// The corners of a polygon, counted around as often as one likes.
class Around {
 public:
  Around(const PointsRef& vertices, const std::vector<int>& corners)
      : vertices_(vertices), corners_(corners) {}
  int n() const { return static_cast<int>(corners_.size()); }
  Vec2 operator()(int k) const { return vertices_.col(corners_[static_cast<std::size_t>((k + n()) % n())]); }

 private:
  const PointsRef& vertices_;
  const std::vector<int>& corners_;
};

bool points_inward(const Around& corner, int at, int end) {
  const Vec2 before = corner(at - 1), here = corner(at), after = corner(at + 1), target = corner(end);
  const bool left_of_out = orientation(here, after, target) > 0;
  const bool left_of_in = orientation(before, here, target) > 0;
  return orientation(before, here, after) > 0 ? left_of_out && left_of_in : left_of_out || left_of_in;
}

double least_sine_at(const Around& corner, int at, int end) {
  const Vec2 here = corner(at);
  const Vec2 diagonal = (corner(end) - here).normalized();
  return std::min(cross((corner(at + 1) - here).normalized(), diagonal),
                  cross(diagonal, (corner(at - 1) - here).normalized()));
}

}  // namespace

bool is_diagonal(const PointsRef& vertices, const std::vector<int>& corners, int start, int end) {
  const Around corner(vertices, corners);
  if (!points_inward(corner, start, end) || !points_inward(corner, end, start)) return false;
  const Vec2 a = corner(start), b = corner(end);
  for (int k = 0; k < corner.n(); ++k) {
    const int next = (k + 1) % corner.n();
    if (k == start || k == end || next == start || next == end) continue;
    if (segments_intersect(a, b, corner(k), corner(next))) return false;
  }
  return true;
}

double least_diagonal_sine(const PointsRef& vertices, const std::vector<int>& corners, int start, int end) {
  const Around corner(vertices, corners);
  return std::min(least_sine_at(corner, start, end), least_sine_at(corner, end, start));
}

std::pair<std::vector<int>, std::vector<int>> split_at(const std::vector<int>& corners, int start, int end) {
  const auto [first, second] = std::minmax(start, end);
  std::vector<int> part(corners.begin() + first, corners.begin() + second + 1);
  std::vector<int> rest(corners.begin() + second, corners.end());
  rest.insert(rest.end(), corners.begin(), corners.begin() + first + 1);
  return {std::move(part), std::move(rest)};
}

}  // namespace polyfem
