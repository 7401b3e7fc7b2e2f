// Whole nonlinear problems of each material: against closed forms, without locking, with Newton's method
// squaring its residual.
#include <polyfem/assembly/history.hpp>
#include <polyfem/assembly/nonlinear_problem.hpp>
#include <polyfem/basis/quadratic_shapes.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/element/finite_strain.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/mean_dilatation.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/small_strain.hpp>
#include <polyfem/material/j2_plasticity.hpp>
#include <polyfem/mesh/edge_midpoints.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace polyfem;

namespace {

/// Once a residual is below 1e-2 the next one is at most `factor` times its square, to round-off.
void expect_squared_residuals(const NewtonReport& report, double factor, double round_off = 1e-11) {
  ASSERT_TRUE(report.converged) << report.reason;
  const std::vector<double>& r = report.residuals;
  for (std::size_t k = 2; k < r.size(); ++k)
    if (r[k - 1] < 1e-2) {
      EXPECT_LT(r[k], std::max(factor * r[k - 1] * r[k - 1], round_off)) << k;
    }
}

void tabulate_first_order(const PointsRef& cell, TabulatedElement& element) {
  tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
}

void tabulate_second_order(const PointsRef& cell, TabulatedElement& element) {
  tabulate_quadratic(cell, dunavant_rule(4), suitable_basis(quadratic_corners(cell)), GradientCorrection::on,
                     element);
}

constexpr double rubber_shear = 80.1938, rubber_lame = 400889.8;  // nu = 0.4999

enum class Rubber { first_order, first_order_mean_dilatation, second_order };

NonlinearProblem::CellForces rubber(Rubber kind) {
  return [kind](int, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
    TabulatedElement element;
    kind == Rubber::second_order ? tabulate_second_order(cell, element) : tabulate_first_order(cell, element);
    const bool mean = kind == Rubber::first_order_mean_dilatation;
    finite_strain_forces(
        element, [mean](Index, const Mat2& F) { return neo_hooke(mean ? 0 : rubber_lame, rubber_shear, F); },
        u, K, forces);
    if (mean)
      add_mean_dilatation(
          element, [](double J) { return neo_hooke_volume(rubber_lame, J); }, u, K, forces);
  };
}

const Points cook = support::polygon_of({{0, 0}, {48, 44}, {48, 60}, {0, 44}});

/// How far the upper right corner of Cook's membrane rises under a shear force of 100 (Simo and Armero 1992).
double rise_of_rubber_membrane(const PolygonMesh& mesh, Rubber kind) {
  NonlinearProblem problem(mesh, 2, rubber(kind), Symmetry::none);
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; }))
    for (const int axis : {0, 1}) problem.hold(v, axis);
  const auto at_right = [](const Vec2& x) { return x.x() == 48; };
  const auto load = [](const Vec2&, const Vec2&) { return VectorXd(Vec2(0, 100. / 16)); };
  if (kind == Rubber::second_order)
    problem.add_edge_loads(quadratic_boundary_edges(mesh, at_right), load);
  else
    problem.add_edge_loads(boundary_edges(mesh, at_right), load);
  constexpr int n_steps = 16;  // longer ones turn cells before Newton's method sees how they resist
  for (int k = 1; k <= n_steps; ++k) {
    expect_squared_residuals(problem.solve(1. * k / n_steps, 1e-9), 1e4, 1e-9);
  }
  for (int v = 0; v < static_cast<int>(mesh.vertices.cols()); ++v)
    if (mesh.vertices.col(v) == cook.col(2)) return problem.solution()[2 * v + 1];
  return 0;
}

TEST(NearlyIncompressibleRubber, DoesNotLockWithMeanDilatation) {
  const PolygonMesh coarse = voronoi(cook, {.n_cells = 300});
  const double limit =
      rise_of_rubber_membrane(with_edge_midpoints(voronoi(cook, {.n_cells = 600})), Rubber::second_order);
  const double locked = rise_of_rubber_membrane(coarse, Rubber::first_order),
               free = rise_of_rubber_membrane(coarse, Rubber::first_order_mean_dilatation);
  EXPECT_NEAR(limit, 6.9, 0.1);  // Simo and Armero 1992, figure 6
  EXPECT_NEAR(free / limit, 1, 0.03);
  EXPECT_LT(locked / limit, 0.7);
}

TEST(NearlyIncompressibleRubber, HomogeneousCompressionIsExact) {
  // P_yy of the stretch `up` with free sides, P_xx = 0: of both unknown stretches by bisection.
  const double up = 0.6;
  double low = 1, high = 3;
  const auto P = [&](double across) {
    return neo_hooke(rubber_lame, rubber_shear, Vec2(across, up).asDiagonal()).P;
  };
  for (int k = 0; k < 60; ++k) (P((low + high) / 2)(0, 0) > 0 ? high : low) = (low + high) / 2;
  const PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = 60});
  NonlinearProblem problem(mesh, 2, rubber(Rubber::first_order_mean_dilatation), Symmetry::none);
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.y() == 0 || x.y() == 1; }))
    problem.hold(v, 1, mesh.vertices(1, v) * (up - 1));
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.x() == 0; })) problem.hold(v, 0);
  for (const double t : {0.25, 0.5, 0.75, 1.}) expect_squared_residuals(problem.solve(t, 1e-10), 1e3);
  const Mat2 G = Vec2(low - 1, up - 1).asDiagonal();
  EXPECT_LT((problem.solution() - (G * mesh.vertices).reshaped()).lpNorm<Eigen::Infinity>(), 1e-9);
}

/// A solution that is made up: the body force that balances it is found by differences of its stress.
Vec2 made_up_displacement(const Vec2& x) {
  return 0.3 * Vec2(std::sin(2 * x.x()) * x.y(), x.x() * x.x() - 0.5 * x.y() * x.y() * x.x());
}

Mat2 made_up_stress(const Vec2& x) {
  const double a = 0.3;
  Mat2 F;
  F << 1 + a * 2 * std::cos(2 * x.x()) * x.y(), a * std::sin(2 * x.x()),  //
      a * (2 * x.x() - 0.5 * x.y() * x.y()), 1 - a * x.y() * x.x();
  return neo_hooke(2, 1, F).P;
}

Vec2 made_up_force(const Vec2& x) {
  const double h = 1e-5;
  Vec2 force = Vec2::Zero();
  for (const int axis : {0, 1}) {
    const Vec2 step = h * Vec2::Unit(axis);
    force -= (made_up_stress(x + step) - made_up_stress(x - step)).col(axis) / (2 * h);
  }
  return force;
}

/// L2 error of displacements of the made-up solution on the unit square.
double made_up_error(const PolygonMesh& mesh, bool second_order) {
  const auto tabulate_cell = second_order ? tabulate_second_order : tabulate_first_order;
  NonlinearProblem problem(
      mesh, 2, [&](int, const PointsRef& cell, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
        TabulatedElement element;
        tabulate_cell(cell, element);
        finite_strain_forces(
            element, [](Index, const Mat2& F) { return neo_hooke(2, 1, F); }, u, K, forces);
        VectorXd load = VectorXd::Zero(forces.size());
        body_force(element, made_up_force, load);
        forces -= load;
      });
  for (const int v : boundary_vertices(mesh))
    for (const int axis : {0, 1}) problem.hold(v, axis, made_up_displacement(mesh.vertices.col(v))[axis]);
  expect_squared_residuals(problem.solve(1, 1e-11), 1e3);
  double sum = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    TabulatedElement element;
    tabulate_cell(mesh.outline(c), element);
    const Points u = problem.solution().reshaped(2, mesh.vertices.cols())(
        Eigen::all, std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()));
    const Points errors = u * element.values.transpose();
    for (Index q = 0; q < element.n_points(); ++q)
      sum += element.rule.weights[q] *
             (errors.col(q) - made_up_displacement(element.rule.points.col(q))).squaredNorm();
  }
  return std::sqrt(sum);
}

TEST(MadeUpLargeStrains, ConvergeAtTheRatesOfTheElements) {
  const auto cells = [](int n) { return voronoi(support::rectangle(1, 1), {.n_cells = n}); };
  const PolygonMesh coarse = cells(64), fine = cells(1024);
  EXPECT_NEAR(std::log(made_up_error(coarse, false) / made_up_error(fine, false)) / std::log(4.), 2, 0.1);
  const PolygonMesh coarse_2 = with_edge_midpoints(coarse), fine_2 = with_edge_midpoints(fine);
  EXPECT_NEAR(std::log(made_up_error(coarse_2, true) / made_up_error(fine_2, true)) / std::log(4.), 3, 0.15);
}

/// Neo-Hooke with damage of the largest energy so far (Simo 1987): P = (1 - d) P0, d = 1 - exp(-W_max / c).
FiniteStress damaged_rubber(const Mat2& F, double largest_before, double& largest) {
  constexpr double lame = 2, shear = 1, c = 0.5;
  const double log_J = std::log(F.determinant());
  const double energy = shear / 2 * (F.squaredNorm() - 2 - 2 * log_J) + lame / 2 * log_J * log_J;
  largest = std::max(largest_before, energy);
  FiniteStress stress = neo_hooke(lame, shear, F);
  const double left = std::exp(-largest / c);
  stress.tangent *= left;
  if (energy > largest_before)
    stress.tangent -= left / c * stress.P.reshaped() * stress.P.reshaped().transpose();
  stress.P *= left;
  return stress;
}

TEST(LargeStrainsWithHistory, APulledSheetRemembersItsLargestStretch) {
  const PolygonMesh mesh = voronoi(support::rectangle(2, 1), {.n_cells = 20});
  History<double> history(mesh.n_cells());
  NonlinearProblem problem(
      mesh, 2, [&](int cell, const PointsRef& polygon, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
        TabulatedElement element;
        tabulate_first_order(polygon, element);
        const auto states = history.cell(cell, element.n_points());
        finite_strain_forces(
            element,
            [&](Index q, const Mat2& F) {
              const auto at = static_cast<std::size_t>(q);
              return damaged_rubber(F, states.before[at], states.now[at]);
            },
            u, K, forces);
      });
  for (const int v : boundary_vertices(mesh)) {
    problem.hold(v, 0, 0.4 * mesh.vertices(0, v));
    problem.hold(v, 1, 0);
  }
  double largest = 0;
  for (const double t : {0.25, 0.5, 0.75, 1., 0.5, 0.25, 0.75, 1.1}) {
    expect_squared_residuals(problem.solve(t, 1e-10), 1e3, 1e-10);
    history.commit();
    const Mat2 F = Vec2(1 + 0.4 * t, 1).asDiagonal();
    double now = 0;
    const double expected = damaged_rubber(F, largest, now).P(0, 0);
    largest = now;
    for (const auto& states : history.states())
      for (const double state : states) EXPECT_NEAR(state, largest, 1e-10) << t;
    double sum = 0;  // of the forces on the right side, per length of it
    for (int c = 0; c < mesh.n_cells(); ++c) {
      TabulatedElement element;
      tabulate_first_order(mesh.outline(c), element);
      const auto states = history.cell(c, element.n_points());
      VectorXd forces;
      MatrixXd K;
      const VectorXd u = problem.solution()
                             .reshaped(2, mesh.vertices.cols())(
                                 Eigen::all, std::vector<int>(mesh.cell(c).begin(), mesh.cell(c).end()))
                             .reshaped();
      finite_strain_forces(
          element,
          [&](Index q, const Mat2& gradient) {
            double unused = 0;
            return damaged_rubber(gradient, states.before[static_cast<std::size_t>(q)], unused);
          },
          u, K, forces);
      for (Index k = 0; k < element.n_vertices(); ++k)
        if (mesh.vertices(0, mesh.cell(c)[static_cast<std::size_t>(k)]) == 2) sum += forces[2 * k];
    }
    EXPECT_NEAR(sum, expected, 1e-10) << t;
  }
}

TEST(History, AStepThatFailsLeavesWhatWasRemembered) {
  History<int> history(2, 7);
  EXPECT_EQ(history.cell(1, 3).before[2], 7);
  history.cell(1, 3).now[2] = 8;
  EXPECT_EQ(history.cell(1, 3).before[2], 7);
  history.commit();
  EXPECT_EQ(history.cell(1, 3).before[2], 8);
  EXPECT_TRUE(history.states()[0].empty());
}

/// The outer radius' displacement of a ring 1 < r < 2 in plane strain, a quarter of it in n x 2n cells of
/// first order, under the inner pressure at which it flows up to the radius c. Incompressible von Mises'
/// material:
///     p = 2 / sqrt(3) Y (ln c + (1 - c^2 / 4) / 2)    (Hill 1950, chapter V),
/// and as u = A / r everywhere, with the shear stress Y / sqrt(3) at r = c, u(2) = Y c^2 / (4 sqrt(3) G).
double outer_displacement_over_hills(int n, double c) {
  const J2Material deviatoric{.bulk = 0, .shear = 400, .yield_stress = 1};
  constexpr double bulk = 4e5;  // nu = 0.4995
  const PolygonMesh ring = mapped(rectangles({1, 0}, {2, 1}, n, 2 * n), [](const Vec2& x) {
    const double angle = std::numbers::pi / 2 * x.y();
    return Vec2(x.x() * std::cos(angle), x.y() == 1 ? x.x() : x.x() * std::sin(angle));
  });
  const double pressure_to_c = 2 / std::sqrt(3.) * (std::log(c) + (1 - c * c / 4) / 2);
  History<PlasticState> history(ring.n_cells());
  NonlinearProblem problem(
      ring, 2, [&](int cell, const PointsRef& polygon, const VectorXd& u, MatrixXd& K, VectorXd& forces) {
        TabulatedElement element;
        tabulate_first_order(polygon, element);
        const auto states = history.cell(cell, element.n_points());
        small_strain_forces(
            element,
            [&](Index q, const Vec3& strain, Mat3& tangent) {
              const auto at = static_cast<std::size_t>(q);
              const PlasticStep step = j2_step(deviatoric, strain, states.before[at]);
              states.now[at] = step.state;
              tangent = step.tangent;
              return step.stress;
            },
            u, K, forces);
        add_mean_dilatation(element, bulk, u, K, forces);
      });
  for (const int axis : {0, 1})
    for (const int v : boundary_vertices(ring, [axis](const Vec2& x) { return std::abs(x[axis]) < 1e-12; }))
      problem.hold(v, axis);
  problem.add_edge_loads(boundary_edges(ring, [](const Vec2& x) { return x.norm() < 1 + 0.1 / 64; }),
                         pressure(pressure_to_c));
  for (int k = 1; k <= 10; ++k) {
    expect_squared_residuals(problem.solve(k / 10., 1e-9), 1e4, 1e-8);
    history.commit();
  }
  return problem.solution()[2 * n] / (c * c / (4 * std::sqrt(3.) * deviatoric.shear));  // at (2, 0)
}

TEST(ThickCylinderOfMises, MovesAsHillsSolution) {
  EXPECT_NEAR(outer_displacement_over_hills(8, 1.5), 1, 0.02);
  EXPECT_NEAR(outer_displacement_over_hills(24, 1.5), 1, 0.003);
}

}  // namespace
