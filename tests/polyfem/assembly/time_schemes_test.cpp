#include <polyfem/assembly/newmark_scheme.hpp>
#include <polyfem/assembly/theta_scheme.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/periodic_vertices.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

using namespace polyfem;

namespace {

const PolygonMesh mesh = voronoi(support::rectangle(1, 1), {.n_cells = 60});
const Vec2 gravity(0.3, -2);

void heat(int, const PointsRef& cell, MatrixXd& K, MatrixXd& M, VectorXd& f) {
  TabulatedElement element;
  tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
  diffusion(element, Mat2::Identity(), K);
  scalar_mass(element, M);
  shape_integrals(element, f);  // a source of 1
}

void elastic(int, const PointsRef& cell, MatrixXd& K, MatrixXd& M, VectorXd& f) {
  TabulatedElement element;
  VectorXd integrals;
  tabulate(cell, dunavant_rule(4), suitable_basis(cell), GradientCorrection::on, element);
  stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), K);
  mass(element, M);
  shape_integrals(element, integrals);
  f = (gravity * integrals.transpose()).reshaped();
}

/// The order that three solutions with dt, dt / 2 and dt / 4 show.
double order_of(const std::function<VectorXd(int n_steps)>& solve, int n_steps) {
  const VectorXd coarse = solve(n_steps), middle = solve(2 * n_steps), fine = solve(4 * n_steps);
  return std::log2((coarse - middle).norm() / (middle - fine).norm());
}

VectorXd warmed(double theta, int n_steps) {
  ThetaScheme scheme(mesh, 1, heat, 0.1 / n_steps, theta);
  for (const int v : boundary_vertices(mesh)) scheme.hold(v, 0);
  VectorXd u(mesh.vertices.cols());
  for (int v = 0; v < u.size(); ++v)
    u[v] =
        std::sin(std::numbers::pi * mesh.vertices(0, v)) * std::sin(std::numbers::pi * mesh.vertices(1, v));
  scheme.set_solution(u);
  for (int k = 0; k < n_steps; ++k) scheme.step();
  EXPECT_NEAR(scheme.time(), 0.1, 1e-15);
  return scheme.solution();
}

TEST(ThetaScheme, IsOfSecondOrderInTheMiddleAndOfFirstAtTheEnd) {
  EXPECT_NEAR(order_of([](int n) { return warmed(0.5, n); }, 20), 2, 0.05);
  EXPECT_NEAR(order_of([](int n) { return warmed(1, n); }, 20), 1, 0.1);
}

TEST(ThetaScheme, EndsAtTheSteadyField) {
  ThetaScheme scheme(mesh, 1, heat, 10, 1);
  FieldProblem steady(mesh, 1);
  MatrixXd M;
  steady.assemble([&](int c, const PointsRef& cell, MatrixXd& K, VectorXd& f) { heat(c, cell, K, M, f); });
  const VectorXd more = VectorXd::LinSpaced(mesh.vertices.cols(), -0.1, 0.2);
  steady.add_loads(more);
  for (const int v : boundary_vertices(mesh)) {
    scheme.hold(v, 0, mesh.vertices(0, v));
    steady.hold(v, 0, mesh.vertices(0, v));
  }
  for (int k = 0; k < 10; ++k) scheme.step(more);
  EXPECT_LT((scheme.solution() - steady.solve()).norm(), 1e-11);
}

TEST(ThetaScheme, KeepsHeatThatNothingTakes) {
  ThetaScheme scheme(mesh, 1, heat, 0.01, 0.5);
  for (int k = 0; k < 5; ++k) scheme.step();
  FieldProblem capacity(mesh, 1);
  MatrixXd K;
  capacity.assemble([&](int c, const PointsRef& cell, MatrixXd& M, VectorXd& f) { heat(c, cell, K, M, f); });
  EXPECT_NEAR((capacity.matrix().selfadjointView<Eigen::Lower>() * scheme.solution()).sum(), 0.05, 1e-13)
      << "a source of 1 on an area of 1 for 0.05 s";
}

TEST(NewmarkScheme, LetsABodyFallAsGalileoSays) {
  NewmarkScheme scheme(mesh, 2, elastic, 0.1);
  const Index n = mesh.vertices.cols();
  const VectorXd none = VectorXd::Zero(2 * n), v = Vec2(1, 0.5).replicate(n, 1);
  scheme.start(none, v, none);
  for (int k = 0; k < 20; ++k) scheme.step();
  const double t = scheme.time();
  const VectorXd expected = (t * Vec2(1, 0.5) + t * t / 2 * gravity).replicate(n, 1);
  EXPECT_LT((scheme.displacements() - expected).lpNorm<Eigen::Infinity>(), 1e-10);
}

VectorXd vibrated(int n_steps) {
  NewmarkScheme scheme(mesh, 2, elastic, 1. / n_steps);
  for (const int v : boundary_vertices(mesh, [](const Vec2& x) { return x.y() == 0; }))
    for (const int axis : {0, 1}) scheme.hold(v, axis);
  VectorXd velocity(2 * mesh.vertices.cols());
  for (int v = 0; v < mesh.vertices.cols(); ++v)
    velocity.segment<2>(2 * v) << std::pow(mesh.vertices(1, v), 2), 0;
  const VectorXd none = VectorXd::Zero(velocity.size());
  scheme.start(none, velocity, none);
  for (int k = 0; k < n_steps; ++k) scheme.step();
  return scheme.displacements();
}

TEST(NewmarkScheme, IsOfSecondOrder) {
  EXPECT_NEAR(order_of(vibrated, 100), 2, 0.1);
}

TEST(NewmarkScheme, KeepsEnergyWithoutLoads) {
  const auto without_loads = [](int c, const PointsRef& cell, MatrixXd& K, MatrixXd& M, VectorXd& f) {
    elastic(c, cell, K, M, f);
    f.setZero();
  };
  const VectorXd none = VectorXd::Zero(2 * mesh.vertices.cols());
  const VectorXd u = 0.01 * VectorXd::LinSpaced(none.size(), -1, 1).array().sin();
  for (const double gamma : {0.5, 0.6}) {
    NewmarkScheme scheme(mesh, 2, without_loads, 0.3, {.beta = gamma / 2, .gamma = gamma});
    scheme.start(u, none, none);
    const double before = scheme.energy();
    for (int k = 0; k < 200; ++k) scheme.step();
    if (gamma == 0.5)
      EXPECT_NEAR(scheme.energy() / before, 1, 1e-10);
    else
      EXPECT_LT(scheme.energy() / before, 0.9) << "gamma above 1/2 damps";
  }
}

TEST(TimeSchemes, RefuseStepsAndParametersThatAreUnstable) {
  EXPECT_THROW(ThetaScheme(mesh, 1, heat, 0, 0.5), Error);
  EXPECT_THROW(ThetaScheme(mesh, 1, heat, 1, 0.4), Error);
  EXPECT_THROW(NewmarkScheme(mesh, 2, elastic, 1, {.beta = 0.2, .gamma = 0.5}), Error);
  EXPECT_THROW(ThetaScheme(mesh, 1, heat, 1, 0.5).set_solution(VectorXd::Zero(3)), Error);
  EXPECT_THROW(ThetaScheme(mesh, 2, heat, 1, 0.5), Error) << "matrices of one component";
}

TEST(ThetaScheme, ATiedFieldStaysPeriodic) {
  // Heat that runs through a periodic strip: cos(2 pi x) decays by exp(-4 pi^2 t), left and right alike.
  const PolygonMesh strip = rectangles({0, 0}, {1, 0.1}, 40, 2);
  ThetaScheme scheme(
      strip, 1,
      [](int, const PointsRef& cell, MatrixXd& K, MatrixXd& M, VectorXd& f) {
        TabulatedElement element;
        tabulate(cell, element);
        diffusion(element, Mat2::Identity(), K);
        scalar_mass(element, M);
        f.setZero(element.n_vertices());
      },
      0.001, 0.5);
  for (const auto& [left, right] : periodic_vertices(strip, Vec2(1, 0))) scheme.tie(right, 0, {{left, 0}});
  const auto wave = [&](double t) {
    return VectorXd((2 * std::numbers::pi * strip.vertices.row(0).transpose().array()).cos() *
                    std::exp(-4 * std::numbers::pi * std::numbers::pi * t));
  };
  scheme.set_solution(wave(0));
  for (int k = 0; k < 20; ++k) scheme.step();
  EXPECT_LT((scheme.solution() - wave(0.02)).lpNorm<Eigen::Infinity>(), 2e-3);
  for (const auto& [left, right] : periodic_vertices(strip, Vec2(1, 0)))
    EXPECT_EQ(scheme.solution()[left], scheme.solution()[right]);
}

TEST(NewmarkScheme, ABodyOnRollersSlidesDownAnInclinedFloor) {
  const Vec2 normal(std::sin(0.3), std::cos(0.3)), down(std::cos(0.3), -std::sin(0.3));
  NewmarkScheme scheme(mesh, 2, elastic, 0.05);
  for (const int v : boundary_vertices(mesh)) scheme.roll(v, normal);
  const VectorXd none = VectorXd::Zero(2 * mesh.vertices.cols());
  scheme.start(none, none, none);
  for (int k = 0; k < 40; ++k) scheme.step();
  // Nothing acts along the floor but gravity: there the centre of mass falls as Galileo says.
  const VectorXd along = down.replicate(mesh.vertices.cols(), 1);
  const auto M = scheme.matrices().mass().selfadjointView<Eigen::Lower>();
  const double t = scheme.time(), moved = along.dot(M * scheme.displacements()) / along.dot(M * along);
  EXPECT_NEAR(moved, gravity.dot(down) * t * t / 2, 1e-10);
  for (const int v : boundary_vertices(mesh))
    for (const VectorXd& motion : {scheme.displacements(), scheme.velocities(), scheme.accelerations()})
      EXPECT_NEAR(motion.segment<2>(2 * v).dot(normal), 0, 1e-10);
}

}  // namespace
