#include <ddacontact/block/stress_projection.hpp>

#include <ddacontact/block/block.hpp>
#include <polyfem/element/matrices.hpp>

#include <Eigen/Cholesky>

#include <cassert>

namespace ddacontact {

namespace {
constexpr double negligible_stiffness = 1e-13;  // of the mean diagonal entry
}

Points stress_projection(const polyfem::TabulatedElement& element, const MatrixXd& stiffness,
                         const PointsRef& outline, const Eigen::Ref<const Tensors>& stress,
                         const polyfem::Basis& basis) {
  // K w = integral of B^T sigma. Rigid motions are made stiff, and so is, a little, whatever else a
  // rank-deficient rule leaves without stiffness.
  const Index n = outline.cols();
  assert(stiffness.rows() == 2 * n && stress.cols() == element.n_points());
  const Vec2 centroid = polyfem::area_moments(outline).centroid;
  RigidModes rigid;
  rigid.resize(2 * n, Eigen::NoChange);
  for (Index i = 0; i < n; ++i) {
    const Vec2 r = outline.col(i) - centroid;
    rigid.row(2 * i) << 1, 0, -r.y();
    rigid.row(2 * i + 1) << 0, 1, r.x();
  }
  rigid.colwise().normalize();
  const double scale = stiffness.trace() / static_cast<double>(2 * n);
  MatrixXd K = stiffness + scale * rigid * rigid.transpose();
  K.diagonal().array() += negligible_stiffness * scale;
  VectorXd f(2 * n);
  polyfem::stress_forces(element, stress, f);
  Points w = K.llt().solve(f).reshaped(2, n);

  // K was made with gradients corrected by a constant c_i each: their part is a uniform strain.
  polyfem::ShapeValues shape;
  basis(outline, element.rule.points.col(0), shape);
  const VectorXd cx = element.dx.row(0).transpose() - shape.gradients.row(0).transpose(),
                 cy = element.dy.row(0).transpose() - shape.gradients.row(1).transpose();
  const Vec2 u_by_x = w * cx, u_by_y = w * cy;
  const Vec3 strain(u_by_x.x(), u_by_y.y(), u_by_y.x() + u_by_x.y());
  w += uniform_strain_displacement(outline, centroid, strain);
  return w;
}

}  // namespace ddacontact
