#include <ddacontact/block/corotational_shape.hpp>

#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

#include <cmath>

namespace ddacontact {

CorotationalShape wachspress_shape(const BlockMaterial& material, const PointsRef& block_outline,
                                   const Integration& integration) {
  const Points outline = block_outline.colwise() - polyfem::area_moments(block_outline).centroid;
  polyfem::TabulatedElement element;
  tabulate(outline, *integration.triangle_rule, polyfem::wachspress, integration.correction, element);
  MatrixXd K, M;
  polyfem::stiffness(element, material.elasticity, K);
  polyfem::mass(element, M);
  const Index n = outline.cols();
  MatrixXd node_mass(n, n);
  for (Index a = 0; a < n; ++a)
    for (Index b = 0; b < n; ++b) node_mass(a, b) = material.density * M(2 * a, 2 * b);
  return {outline,
          element,
          node_mass,
          VectorXd::Ones(n),
          MatrixXd::Identity(n, n),
          MatrixXd::Identity(n, n),
          {outline, polyfem::mean_gradient_weights(outline), K},
          {}};
}

CorotationalShape affine_shape(const BlockMaterial& material, const PointsRef& outline,
                               const std::optional<ControlVertices>& control) {
  const polyfem::AreaMoments moments = polyfem::area_moments(outline);
  const double size = std::sqrt(moments.area);
  Points nodes(2, 3), weights(2, 3);
  nodes << Vec2::Zero(), size * Mat2::Identity();
  weights << Vec2::Zero(), Mat2::Identity() / size;

  polyfem::TabulatedElement element;
  element.area = moments.area;
  element.rule = {Vec2::Zero(), VectorXd::Constant(1, moments.area)};
  element.values = Eigen::RowVector3d(1, 0, 0);
  element.dx = Eigen::RowVector3d(0, 1 / size, 0);
  element.dy = Eigen::RowVector3d(0, 0, 1 / size);
  MatrixXd K;
  polyfem::stiffness(element, material.elasticity, K);

  MatrixXd mass = MatrixXd::Zero(3, 3);
  mass(0, 0) = material.density * moments.area;
  mass.bottomRightCorner<2, 2>() = material.density / (size * size) * moments.second;

  const Index n = outline.cols();
  MatrixXd of_outline(n, 3);
  of_outline << VectorXd::Ones(n), (outline.colwise() - moments.centroid).transpose() / size;
  const MatrixXd nodes_of_outline = of_outline.colPivHouseholderQr().solve(MatrixXd::Identity(n, n));

  MatrixXd basis;
  if (control) {
    MatrixXd displacements = MatrixXd::Zero(6, 6);  // of the control vertices, by the changes of the nodes
    for (int k = 0; k < 3; ++k)
      for (int a = 0; a < 3; ++a) {
        displacements(2 * k, 2 * a) = of_outline(control->x[k], a);
        displacements(2 * k + 1, 2 * a + 1) = of_outline(control->y[k], a);
      }
    basis = displacements.inverse();
  }
  const VectorXd translation = Vec3(1, 0, 0);
  return {nodes, element, mass, translation, of_outline, nodes_of_outline, {nodes, weights, translation, K},
          basis};
}

}  // namespace ddacontact
