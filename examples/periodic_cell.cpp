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

bool is_soft(const PointsRef& cell) {
  return (area_moments(cell).centroid - Vec2(0.5, 0.5)).squaredNorm() < 0.1061;
}
const Mat3& stiffness_of(const PointsRef& cell) {
  return is_soft(cell) ? inclusion : matrix;
}
void tabulate_cell(int, const PointsRef& cell, TabulatedElement& element) {
  tabulate(cell, element);
}

/// The average stress under a uniform strain (xx, yy, 2 xy).
Vec3 average_stress(const PolygonMesh& mesh, const Vec3& strain) {
  const Mat2 E = (Mat2() << strain[0], strain[2] / 2, strain[2] / 2, strain[1]).finished();
  FieldProblem problem(mesh, 2);
  problem.assemble([](int c, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    TabulatedElement element;
    tabulate_cell(c, cell, element);
    stiffness(element, stiffness_of(cell), K);
  });
  for (const int axis : {0, 1}) problem.hold(0, axis);  // the lower left corner
  for (const Vec2& period : {Vec2(1, 0), Vec2(0, 1)})
    for (const auto& [vertex, moved] : periodic_vertices(mesh, period))
      for (const int axis : {0, 1}) problem.tie(moved, axis, {{vertex, axis}}, (E * period)[axis]);

  const Tensors stresses = stress_field(mesh, problem.solve(), tabulate_cell, [&](int c) {
                             return stiffness_of(mesh.outline(c));
                           }).stress.of_cells;
  Vec3 sum = Vec3::Zero();
  for (int c = 0; c < mesh.n_cells(); ++c) sum += area_moments(mesh.outline(c)).area * stresses.col(c);
  return sum;  // the area is 1
}

int main() {
  const PolygonMesh mesh = hexagons({0, 0}, {1, 1}, 40, 41);  // the rows at both sides are alike
  Mat3 D;
  for (int k = 0; k < 3; ++k) D.col(k) = average_stress(mesh, Vec3::Unit(k));
  double part = 0;
  for (int c = 0; c < mesh.n_cells(); ++c)
    if (is_soft(mesh.outline(c))) part += area_moments(mesh.outline(c)).area;
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
