// A cantilever of Voronoi cells, and the beam of Timoshenko and Goodier.
//
//        y ^                                       length L, height H, plane strain;
//    held  |                                       at the right end the shear stresses
//      x|==+=====================+ | P                 t_y = 3 P (H^2/4 - y^2) 2 / H^3,
//      x|  +--> x                | v parabola          a parabola, add up to the force P upwards.
//      x|========================+
//
// With I = H^3/12, and E' = E / (1 - nu^2), nu' = nu / (1 - nu) for plane strain,
//
//    u_x = -P y / (6 E' I) [ (6 L - 3 x) x + (2 + nu') (y^2 - H^2/4) ],
//    u_y =  P / (6 E' I) [ 3 nu' y^2 (L - x) + (4 + 5 nu') H^2 x / 4 + (3 L - x) x^2 ],
//    sigma_xx = -P (L - x) y / I,   sigma_xy = P (H^2/4 - y^2) / (2 I),   sigma_yy = 0
//
// solve all equations. The left end is held at these displacements, for it is not plane. The program compares
// displacements in the mean (L2) and writes cantilever_polygons.vtu with displacements and stresses.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/io/mesh_file.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <iostream>

using namespace polyfem;

constexpr double L = 2, H = 1, I = H * H * H / 12, P = 1;
constexpr double young = 1000, poisson = 0.3;

Vec2 exact(const Vec2& x) {
  constexpr double E = young / (1 - poisson * poisson), nu = poisson / (1 - poisson);
  const double y2 = x.y() * x.y();
  return P / (6 * E * I) *
         Vec2(-x.y() * ((6 * L - 3 * x.x()) * x.x() + (2 + nu) * (y2 - H * H / 4)),
              3 * nu * y2 * (L - x.x()) + (4 + 5 * nu) * H * H * x.x() / 4 + (3 * L - x.x()) * x.x() * x.x());
}

int main() {
  Points beam(2, 4);
  beam << 0, L, L, 0,  //
      -H / 2, -H / 2, H / 2, H / 2;
  const PolygonMesh mesh = voronoi(beam, {.n_cells = 3000});
  const Mat3 D = elasticity_matrix(young, poisson, Plane::strain);
  TabulatedElement element;

  FieldProblem problem(mesh, 2);  // two unknowns a vertex: displacements
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    tabulate(cell, hammer_rule(3), wachspress, GradientCorrection::on, element);
    stiffness(element, D, K);
  });
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
    for (const int axis : {0, 1}) problem.hold(v, axis, exact(mesh.vertices.col(v))[axis]);
  problem.add_edge_loads(
      boundary_edges(mesh, [](const Vec2& x) { return x.x() == L; }),
      [](const Vec2& x, const Vec2&) { return Vec2(0, P * (H * H / 4 - x.y() * x.y()) / (2 * I)); });
  const Points u = problem.solve().reshaped(2, mesh.vertices.cols());

  double error = 0, norm = 0;
  Tensors stress(3, mesh.n_cells()), strain;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate(mesh.outline(c), hammer_rule(3), wachspress, GradientCorrection::on, element);
    const Points d = u(Eigen::all, std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()));
    strains(element, d.reshaped(), strain);
    stress.col(c) = D * strain * element.rule.weights / element.area;  // the mean of the cell
    for (Index q = 0; q < element.n_points(); ++q) {
      const Vec2 x = element.rule.points.col(q),
                 difference = d * element.values.row(q).transpose() - exact(x);
      error += element.rule.weights[q] * difference.squaredNorm();
      norm += element.rule.weights[q] * exact(x).squaredNorm();
    }
  }
  error = std::sqrt(error / norm);

  MeshFile file(mesh);
  file.add_vertex_field("displacement", u);
  file.add_cell_field("stress", stress);  // xx, yy, xy
  file.write("cantilever_polygons.vtu");

  const double force = problem.reactions().reshaped(2, mesh.vertices.cols()).row(1).sum();
  std::cout << mesh.n_cells() << " cells: displacements are off by " << error
            << " of their size in the mean\nthe support carries " << force << " of " << P << '\n';
  return error < 4e-4 && std::abs(force + P) < 1e-9 ? 0 : 1;
}
