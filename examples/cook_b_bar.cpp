// Cook's membrane of a nearly incompressible material: plain elements lock, B-bar elements do not.
//
//                _- C    A tapered panel in plane strain with corners (0, 0), (48, 44), C (48, 60) and
//            _-'    |    (0, 44), clamped at its left side. A shear force F = 100 is spread evenly over the
//        _-'        | ^  right side; how far does C rise? We seek u, zero on the left side, with
//    o-'            | |
//   /|              | F    integral of eps(v) . D eps(u) = integral over the right side of v . (0, F / 16)
//   /|            _-'
//   /|          _-'      for all such v; E = 250 and nu = .4999. The part of D that resists a change of
//   /|        _-'        area, lambda = E nu / ((1 + nu)(1 - 2 nu)), is then 5000 times mu: each element
//   /|      _-'          must keep its area at every point, for which it has too few unknowns. B-bar
//   /|    _-'            elements keep it on the whole; in their energy
//   /|  _-'
//   /o-'                   lambda (mean theta)^2   stands in place of   lambda theta^2,   theta = div u.
//
// The element is one call either way. The exact rise is 7.771, extrapolated from 65 536 cells.
#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <cmath>
#include <cstdio>

using namespace polyfem;

namespace {

constexpr double width = 48, left_height = 44, right_height = 16, force = 100;

Points panel() {
  Points corners(2, 4);
  corners << 0, width, width, 0,  //
      0, left_height, left_height + right_height, left_height;
  return corners;
}

/// n x n quadrilaterals: the unit square's cells, moved to the panel.
PolygonMesh quadrilaterals(int n) {
  return mapped(rectangles(Vec2(0, 0), Vec2(1, 1), n, n), [](const Vec2& x) {
    const double bottom = left_height * x.x(), top = left_height + right_height * x.x();
    return Vec2(width * x.x(), bottom + (top - bottom) * x.y());
  });
}

using Stiffness = void (*)(const TabulatedElement&, const Mat3&, MatrixXd&);

/// How far the corner C rises.
double rise(const PolygonMesh& mesh, Stiffness element_stiffness) {
  const Mat3 D = elasticity_matrix(250, 0.4999, Plane::strain);
  TabulatedElement element;
  FieldProblem problem(mesh, 2);
  problem.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
    tabulate_to_tolerance(polygon, suitable_basis(polygon), 1e-3, GradientCorrection::on, element);
    element_stiffness(element, D, K);
  });
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
    for (const int axis : {0, 1}) problem.hold(v, axis);
  problem.add_edge_loads(boundary_edges(mesh, [](const Vec2& x) { return x.x() == width; }),
                         [](const Vec2&, const Vec2&) { return VectorXd(Vec2(0, force / right_height)); });
  const Vec2 corner(width, left_height + right_height);
  const int at = boundary_vertices(mesh, [&](const Vec2& x) { return x == corner; }).at(0);
  return problem.solve()[2 * at + 1];
}

}  // namespace

int main() {
  constexpr double exact = 7.771;
  std::printf(
      "cells      quadrilaterals      Voronoi cells\n           plain    B-bar      plain    B-bar\n");
  double plain = 0, by_quadrilaterals = 0, by_voronoi_cells = 0;
  for (int n = 8; n <= 32; n *= 2) {
    const PolygonMesh quads = quadrilaterals(n), cells = voronoi(panel(), {.n_cells = n * n});
    plain = rise(cells, stiffness);
    by_quadrilaterals = rise(quads, b_bar_stiffness);
    by_voronoi_cells = rise(cells, b_bar_stiffness);
    std::printf("%5d %10.3f %8.4f %10.3f %8.4f\n", n * n, rise(quads, stiffness), by_quadrilaterals, plain,
                by_voronoi_cells);
  }
  const auto error = [](double rise_of_corner) { return std::abs(rise_of_corner / exact - 1); };
  return error(plain) > 0.4 && error(by_quadrilaterals) < 0.015 && error(by_voronoi_cells) < 0.01 ? 0 : 1;
}
