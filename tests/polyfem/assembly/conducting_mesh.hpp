/// \file A mesh of 90 cells with its elasticity and conduction.
#pragma once

#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <string>

namespace support {

using namespace polyfem;

inline const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);

inline void elastic(int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
  TabulatedElement element;
  tabulate(polygon, hammer_rule(3), wachspress, GradientCorrection::on, element);
  stiffness(element, D, K);
}

/// The integral of grad N_i . grad N_j, and with a source the integrals of N_i.
inline void conduct(const PointsRef& polygon, MatrixXd& K) {
  TabulatedElement element;
  tabulate(polygon, hammer_rule(3), wachspress, GradientCorrection::on, element);
  const auto w = element.rule.weights.asDiagonal();
  K = element.dx.transpose() * w * element.dx + element.dy.transpose() * w * element.dy;
}
inline void conducting(int, const PointsRef& polygon, MatrixXd& K, VectorXd&) {
  conduct(polygon, K);
}

inline const PolygonMesh mesh = voronoi(support::rectangle(3, 1), {.n_cells = 90});
inline bool at_left(const Vec2& x) {
  return x.x() == 0;
}
inline bool at_right(const Vec2& x) {
  return x.x() == 3;
}

inline void clamp_left(FieldProblem& problem) {
  for (const int v : boundary_vertices(mesh, at_left))
    for (const int component : {0, 1}) problem.hold(v, component);
}

inline std::string message_of(FieldProblem& problem) {
  try {
    problem.solve();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace support
