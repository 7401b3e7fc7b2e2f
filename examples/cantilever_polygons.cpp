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
// displacements in the mean (L2), writes cantilever_polygons.vtu with displacements and stresses, and draws
// the stress sigma_xx as the shape functions have it: cantilever_polygons.svg.
#include <ddacontact/picture/picture.hpp>
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/io/mesh_file.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <fstream>
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

const Mat3 D = elasticity_matrix(young, poisson, Plane::strain);

/// Shape functions that suit the cell, at points that give its stiffness to 1e-3.
void tabulate_cell(const PointsRef& cell, TabulatedElement& element) {
  tabulate_to_tolerance(cell, suitable_basis(cell), 1e-3, GradientCorrection::on, element);
}

FieldProblem solved(const PolygonMesh& mesh) {
  FieldProblem problem(mesh, 2);  // two unknowns a vertex: displacements
  TabulatedElement element;
  problem.assemble([&](int, const PointsRef& cell, MatrixXd& K, VectorXd&) {
    tabulate_cell(cell, element);
    stiffness(element, D, K);
  });
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
    for (const int axis : {0, 1}) problem.hold(v, axis, exact(mesh.vertices.col(v))[axis]);
  problem.add_edge_loads(
      boundary_edges(mesh, [](const Vec2& x) { return x.x() == L; }),
      [](const Vec2& x, const Vec2&) { return Vec2(0, P * (H * H / 4 - x.y() * x.y()) / (2 * I)); });
  problem.solve();
  return problem;
}

/// Displacements of a cell's vertices, one a column.
Points of_cell(const PolygonMesh& mesh, int cell, const VectorXd& u) {
  return u.reshaped(2, mesh.vertices.cols())(
      Eigen::all, std::vector<int>(mesh.cell(cell).begin(), mesh.cell(cell).end()));
}

/// Relative, in the mean (L2).
double error(const PolygonMesh& mesh, const VectorXd& u) {
  double error = 0, norm = 0;
  TabulatedElement element;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate_cell(mesh.outline(c), element);
    const VectorXd d = of_cell(mesh, c, u).reshaped();
    error += squared_displacement_error(element, d, exact);
    norm += squared_displacement_error(element, VectorXd::Zero(d.size()), exact);
  }
  return std::sqrt(error / norm);
}

/// For ParaView: displacements, and the mean stress (xx, yy, xy) of each cell.
void write_vtu(const PolygonMesh& mesh, const VectorXd& u) {
  Tensors stress(3, mesh.n_cells()), strain;
  TabulatedElement element;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    tabulate_cell(mesh.outline(c), element);
    strains(element, of_cell(mesh, c, u).reshaped(), strain);
    stress.col(c) = D * strain * element.rule.weights / element.area;
  }
  MeshFile file(mesh);
  file.add_vertex_field("displacement", u.reshaped(2, mesh.vertices.cols()));
  file.add_cell_field("stress", stress);
  file.write("cantilever_polygons.vtu");
}

/// A picture of sigma_xx as the shape functions have it inside each cell: for the pictures of ddacontact
/// every cell is a block.
void draw_stress(const PolygonMesh& mesh, const VectorXd& u) {
  ddacontact::Frame frame;
  frame.material_names = {"beam"};
  frame.elasticity = {D};
  frame.materials.assign(static_cast<std::size_t>(mesh.n_cells()), 0);
  frame.position.resize(2, static_cast<Index>(mesh.indices.size()));
  frame.strain_displacement.resize(2, frame.position.cols());
  frame.stress_offset.setZero(3, mesh.n_cells());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const int first = mesh.offsets[c], count = mesh.offsets[c + 1] - first;
    frame.blocks.push_back({first, count});
    frame.strain_displacement.middleCols(first, count) = of_cell(mesh, c, u);
    frame.position.middleCols(first, count) = mesh.outline(c);
    frame.add_outline_cell(c);
  }
  const ddacontact::Panel panel{.frame = &frame, .field = ddacontact::Field::sxx};
  std::ofstream("cantilever_polygons.svg") << ddacontact::draw({panel}, {.title = "Cantilever, 200 cells"});
}

int main() {
  Points beam(2, 4);
  beam << 0, L, L, 0,  //
      -H / 2, -H / 2, H / 2, H / 2;
  const PolygonMesh coarse = voronoi(beam, {.n_cells = 200});
  draw_stress(coarse, solved(coarse).solution());

  const PolygonMesh fine = voronoi(beam, {.n_cells = 3000});
  const FieldProblem problem = solved(fine);
  write_vtu(fine, problem.solution());
  const double off = error(fine, problem.solution());
  const double force = problem.reactions().reshaped(2, fine.vertices.cols()).row(1).sum();
  std::cout << fine.n_cells() << " cells: displacements are off by " << off
            << " of their size in the mean\nthe support carries " << force << " of " << P
            << "\nstress: cantilever_polygons.svg, .vtu\n";
  return off < 4e-4 && std::abs(force + P) < 1e-9 ? 0 : 1;
}
