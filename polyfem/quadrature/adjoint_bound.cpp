#include <polyfem/quadrature/adjoint_bound.hpp>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace polyfem {

AdjointBound::AdjointBound(const PointsRef& polygon) : sides_(Points::Zero(2, polygon.cols())) {
  const Index n = polygon.cols();
  if (n == 3) return;  // the adjoint is constant
  // Lengths by a power of two: the same digits at any size.
  const double scale = std::exp2(std::floor(std::log2(polygon.cwiseAbs().maxCoeff())));
  Eigen::Matrix3Xd edges(3, n), poles(3, n);  // in homogeneous coordinates
  for (Index k = 0; k < n; ++k) {
    const Vec2 vertex = polygon.col(k) / scale, edge = polygon.col((k + 1) % n) / scale - vertex;
    const double height = cross(vertex, edge);
    edges.col(k) << edge.y() / height, -edge.x() / height, -1;
  }
  for (Index k = 0; k < n; ++k)
    poles.col(k) = edges.col((k + n - 1) % n).cross(edges.col((k + 1) % n)).normalized();
  for (Index k = 0; k < n; ++k) {
    const Vec3 side = poles.col((k + n - 1) % n).cross(poles.col(k));
    sides_.col(k) = -side.head<2>() / side.z() / scale;
  }
}

double AdjointBound::reach(const Vec2& p, const Vec2& q) const {
  double nearness = 1e-6;
  for (Index k = 0; k < sides_.cols(); ++k) {
    const double approach = sides_.col(k).dot(q - p), distance = 1 - sides_.col(k).dot(q);
    nearness = std::max(nearness, approach / std::max(distance, 1e-9 * approach));  // < 0 when receding
  }
  return 1 / nearness;
}

}  // namespace polyfem
