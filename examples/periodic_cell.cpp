// The stiffness of a composite from one cell of its pattern: round soft inclusions in a square array.
//
// Displacements are a uniform strain plus what repeats from cell to cell: u(x + p) = u(x) + E p for both
// periods p. So each vertex on the right side follows its partner on the left, each on top its partner below
// (`tie`). Of a third of the area in inclusions a tenth as stiff, the average must lie between the bounds of
// Voigt (equal strains) and Reuss (equal stresses), and have the symmetry of the square.
#include <polyfem/polyfem.hpp>

#include <Eigen/Dense>

#include <cmath>
#include <cstdlib>
#include <iostream>

using namespace polyfem;

const Mat3 matrix = elasticity_matrix(10, 0.3, Plane::strain),
           inclusion = elasticity_matrix(1, 0.3, Plane::strain);

/// The average stress under a uniform strain (xx, yy, 2 xy).
Vec3 average_stress(const PolygonMesh& mesh, const Vec3& strain, double& part_of_inclusions) {
  const Mat2 E = (Mat2() << strain[0], strain[2] / 2, strain[2] / 2, strain[1]).finished();
  const auto stiffness_at = [](const PointsRef& cell) -> const Mat3& {
    return (area_moments(cell).centroid - Vec2(0.5, 0.5)).squaredNorm() < 0.1061 ? inclusion : matrix;
  };
  FieldProblem problem(mesh, 2);
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    TabulatedElement element;
    tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
    stiffness(element, stiffness_at(cell), K);
  });
  for (const int axis : {0, 1}) problem.hold(0, axis);  // the lower left corner
  for (const Vec2& period : {Vec2(1, 0), Vec2(0, 1)})
    for (const auto& [vertex, moved] : periodic_vertices(mesh, period))
      for (const int axis : {0, 1}) problem.tie(moved, axis, {{vertex, axis}}, (E * period)[axis]);
  problem.solve();

  Vec3 stress = Vec3::Zero();
  part_of_inclusions = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    TabulatedElement element;
    tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
    const VectorXd u = problem.cell_solution(c);
    const auto ux = u(Eigen::seq(0, Eigen::last, 2)), uy = u(Eigen::seq(1, Eigen::last, 2));
    for (Index q = 0; q < element.rule.weights.size(); ++q) {
      const Vec3 strain_here(element.dx.row(q).dot(ux), element.dy.row(q).dot(uy),
                             element.dy.row(q).dot(ux) + element.dx.row(q).dot(uy));
      stress += element.rule.weights[q] * (stiffness_at(cell) * strain_here);
      if (&stiffness_at(cell) == &inclusion) part_of_inclusions += element.rule.weights[q];
    }
  }
  return stress;
}

int main() {
  const PolygonMesh mesh = hexagons({0, 0}, {1, 1}, 40, 41);  // the rows at both sides are alike
  Mat3 D;
  double part = 0;
  for (int k = 0; k < 3; ++k) D.col(k) = average_stress(mesh, Vec3::Unit(k), part);
  const Mat3 voigt = part * inclusion + (1 - part) * matrix,
             reuss = (part * inclusion.inverse() + (1 - part) * matrix.inverse()).inverse();
  std::cout << "inclusions: " << part << " of the area\nstiffness of the composite:\n"
            << D << "\nbounds of D(0, 0): " << reuss(0, 0) << " and " << voigt(0, 0) << '\n';
  const auto positive = [](const Mat3& difference) {
    return Mat3((difference + difference.transpose()) / 2).ldlt().isPositive();
  };
  const bool is_right = (D - D.transpose()).norm() < 1e-10 && std::abs(D(0, 0) / D(1, 1) - 1) < 1e-2 &&
                        positive(voigt - D) && positive(D - reuss);
  std::cout << (is_right ? "within the bounds\n" : "outside of the bounds\n");
  return is_right ? EXIT_SUCCESS : EXIT_FAILURE;
}
