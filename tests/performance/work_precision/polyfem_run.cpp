#include <tests/performance/work_precision/polyfem_run.hpp>

#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>

#include <Eigen/LU>

#include <cmath>

using namespace polyfem;

namespace work_precision {
namespace {

/// Two Gauss points in each direction of a quadrilateral, four points on each triangle of another cell.
void tabulate_cell(const PointsRef& polygon, TabulatedElement& element) {
  const Basis& basis = suitable_basis(polygon);
  if (polygon.cols() != 4) return tabulate(polygon, hammer_rule(3), basis, GradientCorrection::on, element);
  static PolygonRule rule;
  make_quadrilateral_rule(polygon, 2, rule);
  tabulate(polygon, rule, basis, GradientCorrection::on, element);
}

void apply_boundary_data(const Problem& problem, const PolygonMesh& mesh, FieldProblem& field) {
  std::vector<std::array<int, 2>> loaded;
  for (const std::array<int, 2>& edge : boundary_edges(mesh)) {
    const Boundary boundary = problem.boundary((mesh.vertices.col(edge[0]) + mesh.vertices.col(edge[1])) / 2);
    if (boundary.loaded) loaded.push_back(edge);
    for (const int v : edge) {
      const Vec2 u = problem.exact() ? problem.solution.displacement(mesh.vertices.col(v)) : Vec2::Zero();
      if (boundary.held_x) field.hold(v, 0, u.x());
      if (boundary.held_y) field.hold(v, 1, u.y());
    }
  }
  field.add_edge_loads(loaded, problem.traction);
}

/// The vertical displacement at the watched point, linear along the boundary edge on which it lies.
double watched_displacement(const Problem& problem, const PolygonMesh& mesh, const VectorXd& u) {
  for (const auto& [a, b] : boundary_edges(mesh)) {
    const Vec2 along = mesh.vertices.col(b) - mesh.vertices.col(a),
               to = problem.watched - mesh.vertices.col(a);
    const double share = to.dot(along) / along.squaredNorm();
    if (share >= 0 && share <= 1 && std::abs(cross(along, to)) < 1e-9 * along.squaredNorm())
      return (1 - share) * u[2 * a + 1] + share * u[2 * b + 1];
  }
  return 0;
}

double work_of_constant_traction(const Problem& problem, const PolygonMesh& mesh, const VectorXd& u) {
  double work = 0;
  for (const auto& [a, b] : boundary_edges(mesh)) {
    const Vec2 along = mesh.vertices.col(b) - mesh.vertices.col(a);
    const Vec2 middle = (mesh.vertices.col(a) + mesh.vertices.col(b)) / 2;
    const Vec2 normal = Vec2(along.y(), -along.x()).normalized();
    if (problem.boundary(middle).loaded)
      work +=
          along.norm() * problem.traction(middle, normal).dot(u.segment<2>(2 * a) + u.segment<2>(2 * b)) / 2;
  }
  return work;
}

/// Replaces the change of area at each point by its mean, half of the difference in each direction.
void average_dilatation(const VectorXd& weights, Tensors& strain) {
  const Eigen::RowVectorXd dilatation = strain.topRows<2>().colwise().sum();
  const double mean = dilatation.dot(weights) / weights.sum();
  strain.topRows<2>().rowwise() += ((mean - dilatation.array()) / 2).matrix();
}

/// Of the field itself: by a fine rule and without the correction of gradients.
void measure_errors(const Problem& problem, const PolygonMesh& mesh, const VectorXd& u, Accuracy& result) {
  const Mat3 D = problem.elasticity(), flexibility = D.inverse();
  const auto& displacement = problem.solution.displacement;
  const auto exact_strain = [&](const Vec2& x) { return Vec3(flexibility * problem.solution.stress(x)); };
  double l2 = 0, l2_all = 0, energy = 0, energy_all = 0;
  TabulatedElement element;
  VectorXd d;
  Tensors strain;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points polygon = mesh.outline(c);
    tabulate(polygon, dunavant_rule(6), suitable_basis(polygon), GradientCorrection::off, element);
    d.resize(2 * polygon.cols());
    for (Index i = 0; i < polygon.cols(); ++i)
      d.segment<2>(2 * i) = u.segment<2>(2 * mesh.cell(c)[static_cast<std::size_t>(i)]);
    strains(element, d, strain);
    if (problem.nearly_incompressible) average_dilatation(element.rule.weights, strain);
    l2 += squared_displacement_error(element, d, displacement);
    energy += squared_energy_error(element, D, strain, exact_strain);
    d.setZero();
    strain.setZero();
    l2_all += squared_displacement_error(element, d, displacement);
    energy_all += squared_energy_error(element, D, strain, exact_strain);
  }
  result.l2 = std::sqrt(l2 / l2_all);
  result.energy = std::sqrt(energy / energy_all);
}

}  // namespace

Run run_polyfem(const Problem& problem, const PolygonMesh& mesh, PolyfemElement kind, bool with_errors) {
  Run run;
  Stages& stages = run.stages["cholmod"];
  const Mat3 D = problem.elasticity();
  const auto& force = problem.solution.body_force;
  TabulatedElement element;

  StopWatch watch;
  FieldProblem field(mesh, 2);
  apply_boundary_data(problem, mesh, field);
  stages.pattern = watch.lap();
  field.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    tabulate_cell(polygon, element);
    kind == PolyfemElement::plain ? stiffness(element, D, K) : b_bar_stiffness(element, D, K);
    if (force) body_force(element, force, f);
  });
  stages.assembly = watch.lap();
  field.solve();
  stages.factorization = watch.lap();
  const VectorXd& u = field.solve();
  stages.solve = watch.lap();
  stages.factorization -= stages.solve;

  run.accuracy.n_unknowns = field.n_unknowns();
  if (problem.exact() && with_errors) {
    measure_errors(problem, mesh, u, run.accuracy);
  } else if (!problem.exact()) {
    run.accuracy.watched = watched_displacement(problem, mesh, u);
    run.accuracy.work = work_of_constant_traction(problem, mesh, u);
  }
  return run;
}

}  // namespace work_precision
