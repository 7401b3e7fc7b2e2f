#include <polyfem/geometry/fan_subdivision.hpp>

#include <cassert>

namespace polyfem {
namespace {

/// Where the points of an outline of `corners` vertices are among those of its subdivision.
struct Rings {
  int corners, n;

  int n_points() const { return 1 + corners * n * (n + 1) / 2; }
  /// Point `along` of ring k, counted on from corner `corner`; the last ring is the centre.
  int index(int k, int corner, int along) const {
    if (k == n) return n_points() - 1;
    if (along == n - k) {
      corner = (corner + 1) % corners;
      along = 0;
    }
    const int before = corners * (k * n - k * (k - 1) / 2);  // points of the rings outside
    if (k > 0) return before + corner * (n - k) + along;
    return along == 0 ? corner : corners + corner * (n - 1) + along - 1;
  }
};

}  // namespace

FanSubdivision subdivide_fan(const PointsRef& outline, const Vec2& centre, int n) {
  assert(outline.cols() >= 3 && n >= 1);
  const Rings rings{static_cast<int>(outline.cols()), n};
  FanSubdivision result;
  result.points.resize(2, rings.n_points());
  result.triangles.resize(3, rings.corners * n * n);
  result.points.leftCols(rings.corners) = outline;
  result.points.rightCols<1>() = centre;
  int triangle = 0;
  for (int corner = 0; corner < rings.corners; ++corner) {
    const Vec2 from = outline.col(corner), to = outline.col((corner + 1) % rings.corners);
    for (int k = 0; k < n; ++k) {
      for (int along = 0; along < n - k; ++along) {
        const int here = rings.index(k, corner, along), next = rings.index(k, corner, along + 1);
        if (k > 0 || along > 0)
          result.points.col(here) = ((n - k - along) * from + along * to + k * centre) / n;
        result.triangles.col(triangle++) << here, next, rings.index(k + 1, corner, along);
        if (along > 0)
          result.triangles.col(triangle++) << here, rings.index(k + 1, corner, along),
              rings.index(k + 1, corner, along - 1);
      }
    }
  }
  return result;
}

}  // namespace polyfem
