#include <tests/performance/work_precision/polyfem_run.hpp>

#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/b_bar.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/virtual_element.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
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

/// The edges of the boundary, of two or three vertices, each from its first to its last.
template <std::size_t n>
std::vector<std::array<int, n>> edges_of(const PolygonMesh& mesh) {
  if constexpr (n == 2)
    return boundary_edges(mesh);
  else
    return quadratic_boundary_edges(mesh, [](const Vec2&) { return true; });
}

template <std::size_t n>
void apply_boundary_data(const Problem& problem, const PolygonMesh& mesh, FieldProblem& field) {
  std::vector<std::array<int, n>> loaded;
  for (const std::array<int, n>& edge : edges_of<n>(mesh)) {
    const Boundary boundary =
        problem.boundary((mesh.vertices.col(edge.front()) + mesh.vertices.col(edge.back())) / 2);
    if (boundary.loaded) loaded.push_back(edge);
    for (const int v : edge) {
      const Vec2 u = problem.exact() ? problem.solution.displacement(mesh.vertices.col(v)) : Vec2::Zero();
      if (boundary.fixed_x) field.hold(v, 0, u.x());
      if (boundary.fixed_y) field.hold(v, 1, u.y());
    }
  }
  if (!loaded.empty()) field.add_edge_loads(loaded, problem.traction);
}

/// The displacement at t in (0, 1) along an edge.
template <std::size_t n>
Vec2 on_edge(const VectorXd& u, const std::array<int, n>& edge, double t) {
  const Vec2 first = u.segment<2>(2 * edge.front()), last = u.segment<2>(2 * edge.back());
  if constexpr (n == 2)
    return (1 - t) * first + t * last;
  else
    return (1 - t) * (1 - 2 * t) * first + 4 * t * (1 - t) * u.segment<2>(2 * edge[1]) +
           t * (2 * t - 1) * last;
}

/// The vertical displacement at the watched point, on the boundary edge on which it lies.
template <std::size_t n>
double watched_displacement(const Problem& problem, const PolygonMesh& mesh, const VectorXd& u) {
  for (const std::array<int, n>& edge : edges_of<n>(mesh)) {
    const Vec2 first = mesh.vertices.col(edge.front()), along = mesh.vertices.col(edge.back()) - first,
               to = problem.watched - first;
    const double share = to.dot(along) / along.squaredNorm();
    if (share >= 0 && share <= 1 && std::abs(cross(along, to)) < 1e-9 * along.squaredNorm())
      return on_edge(u, edge, share).y();
  }
  return 0;
}

template <std::size_t n>
double work_of_constant_traction(const Problem& problem, const PolygonMesh& mesh, const VectorXd& u) {
  double work = 0;
  for (const std::array<int, n>& edge : edges_of<n>(mesh)) {
    const Vec2 first = mesh.vertices.col(edge.front()), last = mesh.vertices.col(edge.back());
    const Vec2 along = last - first, middle = (first + last) / 2,
               normal = Vec2(along.y(), -along.x()).normalized();
    if (!problem.boundary(middle).loaded) continue;
    const Vec2 mean = (on_edge(u, edge, 0) + 4 * on_edge(u, edge, 0.5) + on_edge(u, edge, 1)) / 6;  // Simpson
    work += along.norm() * problem.traction(middle, normal).dot(mean);
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
void measure_errors(const Problem& problem, const PolygonMesh& mesh, PolyfemElement kind, const VectorXd& u,
                    Accuracy& result) {
  const Mat3 D = problem.elasticity(), flexibility = D.inverse();
  const auto& displacement = problem.solution.displacement;
  const auto exact_strain = [&](const Vec2& x) { return Vec3(flexibility * problem.solution.stress(x)); };
  double l2 = 0, l2_all = 0, energy = 0, energy_all = 0;
  TabulatedElement element;
  VectorXd d;
  Tensors strain;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points polygon = mesh.outline(c);
    if (kind == PolyfemElement::quadratic)
      tabulate_quadratic(polygon, dunavant_rule(8), suitable_basis(quadratic_corners(polygon)),
                         GradientCorrection::off, element);
    else if (kind == PolyfemElement::virtual_element)
      tabulate_virtual(polygon, dunavant_rule(6), element);
    else
      tabulate(polygon, dunavant_rule(6), suitable_basis(polygon), GradientCorrection::off, element);
    d.resize(2 * polygon.cols());
    for (Index i = 0; i < polygon.cols(); ++i)
      d.segment<2>(2 * i) = u.segment<2>(2 * mesh.cell(c)[static_cast<std::size_t>(i)]);
    strains(element, d, strain);
    if (problem.nearly_incompressible && kind != PolyfemElement::quadratic)
      average_dilatation(element.rule.weights, strain);
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

template <std::size_t n>
static Run run_with_edges_of(const Problem& problem, const PolygonMesh& mesh, PolyfemElement kind,
                             bool with_errors) {
  Run run;
  Stages& stages = run.stages["cholmod"];
  const Mat3 D = problem.elasticity();
  const auto& force = problem.solution.body_force;
  TabulatedElement element;

  StopWatch watch;
  FieldProblem field(mesh, 2);
  apply_boundary_data<n>(problem, mesh, field);
  stages.pattern = watch.lap();
  field.assemble([&](int, const PointsRef& polygon, MatrixXd& K, VectorXd& f) {
    switch (kind) {
      case PolyfemElement::plain:
        tabulate_cell(polygon, element);
        stiffness(element, D, K);
        break;
      case PolyfemElement::b_bar:
        tabulate_cell(polygon, element);
        b_bar_stiffness(element, D, K);
        break;
      case PolyfemElement::quadratic:
        tabulate_quadratic(polygon, element);
        stiffness(element, D, K);
        break;
      case PolyfemElement::virtual_element:
        virtual_stiffness(polygon, D, K);
        if (force) tabulate_virtual(polygon, element);
        break;
    }
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
    measure_errors(problem, mesh, kind, u, run.accuracy);
  } else if (!problem.exact()) {
    run.accuracy.watched = watched_displacement<n>(problem, mesh, u);
    run.accuracy.work = work_of_constant_traction<n>(problem, mesh, u);
  }
  return run;
}

Run run_polyfem(const Problem& problem, const PolygonMesh& mesh, PolyfemElement kind, bool with_errors) {
  if (kind != PolyfemElement::quadratic) return run_with_edges_of<2>(problem, mesh, kind, with_errors);
  return run_with_edges_of<3>(problem, with_edge_midpoints(mesh), kind, with_errors);
}

}  // namespace work_precision
