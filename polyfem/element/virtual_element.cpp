#include <polyfem/element/virtual_element.hpp>
#include <polyfem/geometry/area_moments.hpp>

namespace polyfem {
namespace {

/// The integrals of N_i n over the boundary, over the area: with nodal values u (2 x n) the mean gradient of
/// displacements is u times the transpose, du_a/dx_b in row a.
Points mean_gradients(const PointsRef& polygon, double area) {
  const Index n = polygon.cols();
  Points gradients(2, n);
  for (Index i = 0; i < n; ++i) {
    const Vec2 chord = polygon.col((i + 1) % n) - polygon.col((i + n - 1) % n);
    gradients.col(i) = Vec2(chord.y(), -chord.x()) / (2 * area);
  }
  return gradients;
}

/// The mean strain of nodal values, 3 x 2n.
MatrixXd mean_strain(const Points& gradients) {
  MatrixXd B = MatrixXd::Zero(3, 2 * gradients.cols());
  for (Index i = 0; i < gradients.cols(); ++i) {
    B(0, 2 * i) = B(2, 2 * i + 1) = gradients(0, i);
    B(1, 2 * i + 1) = B(2, 2 * i) = gradients(1, i);
  }
  return B;
}

void tabulate_at_rule(const PointsRef& polygon, double area, TabulatedElement& element) {
  const Points gradients = mean_gradients(polygon, area);
  const Points arms = element.rule.points.colwise() - Vec2(polygon.rowwise().mean());
  element.area = area;
  element.values = (arms.transpose() * gradients).array() + 1. / static_cast<double>(polygon.cols());
  element.dx = gradients.row(0).replicate(arms.cols(), 1);
  element.dy = gradients.row(1).replicate(arms.cols(), 1);
}

}  // namespace

void virtual_stiffness(const PointsRef& polygon, const Mat3& elasticity, MatrixXd& K) {
  const Index n = polygon.cols();
  const double area = signed_area(polygon);
  const Points gradients = mean_gradients(polygon, area);
  const MatrixXd B = mean_strain(gradients);
  const Points arms = polygon.colwise() - Vec2(polygon.rowwise().mean());
  // One component: the projection's values at the vertices, n x n; two components do not mix.
  const MatrixXd rest = MatrixXd::Identity(n, n) - MatrixXd::Constant(n, n, 1. / static_cast<double>(n)) -
                        arms.transpose() * gradients;
  // C^T C of the strains (xx), (yy), (gamma_xy): fields (x, 0), (0, y), (y, x)/2.
  const double sizes = arms.squaredNorm() * 1.25;
  const double s = area * elasticity.trace() / sizes;
  const MatrixXd stabilization = s * rest.transpose() * rest;
  K.noalias() = B.transpose() * (area * elasticity * B);
  for (const int axis : {0, 1}) K(Eigen::seqN(axis, n, 2), Eigen::seqN(axis, n, 2)) += stabilization;
}

void tabulate_virtual(const PointsRef& polygon, TabulatedElement& element) {
  const AreaMoments moments = area_moments(polygon);
  element.rule.points = moments.centroid;
  element.rule.weights.setConstant(1, moments.area);
  tabulate_at_rule(polygon, moments.area, element);
}

void tabulate_virtual(const PointsRef& polygon, const TriangleRule& triangle_rule,
                      TabulatedElement& element) {
  make_polygon_rule(polygon, triangle_rule, element.rule);
  tabulate_at_rule(polygon, signed_area(polygon), element);
}

}  // namespace polyfem
