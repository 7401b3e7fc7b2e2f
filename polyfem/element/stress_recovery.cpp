#include <polyfem/element/stress_recovery.hpp>

#include <Eigen/LU>

#include <cassert>

namespace polyfem {
namespace {

/// Row q of the table holds the gradients.
Vec3 strain_of_row(const ShapeTable& table, Index q, const Eigen::Ref<const VectorXd>& d) {
  Vec3 strain = Vec3::Zero();
  for (Index i = 0; i < table.n_vertices(); ++i) {
    const double dx = table.dx(q, i), dy = table.dy(q, i), u = d[2 * i], v = d[2 * i + 1];
    strain += Vec3(dx * u, dy * v, dy * u + dx * v);
  }
  return strain;
}

}  // namespace

Vec3 strain_at(const PointsRef& polygon, const Basis& basis, const Eigen::Ref<const VectorXd>& d,
               const Vec2& x) {
  assert(d.size() == 2 * polygon.cols());
  thread_local ShapeTable table;
  basis.evaluate(polygon, x, table);
  return strain_of_row(table, 0, d);
}

void vertex_strains(const PointsRef& polygon, const Basis& basis, const Eigen::Ref<const VectorXd>& d,
                    Tensors& strain) {
  assert(d.size() == 2 * polygon.cols());
  thread_local ShapeTable table;
  basis.evaluate(polygon, polygon, table);
  strain.resize(3, polygon.cols());
  for (Index i = 0; i < polygon.cols(); ++i) strain.col(i) = strain_of_row(table, i, d);
}

void extrapolate_to_vertices(const PointsRef& polygon, const TabulatedElement& element,
                             const Eigen::Ref<const MatrixXd>& at_points, MatrixXd& at_vertices) {
  assert(at_points.cols() == element.n_points());
  // Weighted moments about the points' centre, where mean and slope are found apart from each other.
  const VectorXd& w = element.rule.weights;
  const Vec2 centre = element.rule.points * w / element.area;
  const Points from_centre = element.rule.points.colwise() - centre;
  const Points weighted = from_centre * w.asDiagonal();
  const Mat2 second = weighted * from_centre.transpose();
  const VectorXd mean = at_points * w / element.area;
  const Eigen::MatrixX2d slope = at_points * weighted.transpose() * second.inverse();
  at_vertices = (slope * (polygon.colwise() - centre)).colwise() + mean;
}

}  // namespace polyfem
