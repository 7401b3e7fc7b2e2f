#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/suitable_basis.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/default_element.hpp>
#include <polyfem/element/diffusion.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/element/quadratic_element.hpp>
#include <polyfem/element/tolerance.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <polyfem/quadrature/graded_rule.hpp>
#include <tests/support/concave_polygons.hpp>
#include <tests/support/quadratic_cells.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include <array>
#include <vector>

using namespace polyfem;

namespace {

std::vector<Points> polygons() {
  std::vector<Points> polygons;
  std::mt19937 random(11);
  for (int n = 3; n <= 10; ++n) polygons.push_back(support::random_convex_polygon(n, random));
  for (const auto& [name, polygon] : support::concave_polygons()) polygons.push_back(polygon);
  return polygons;
}

/// The element by a rule of symmetric points and by one that is exact for no polynomial.
std::vector<TabulatedElement> elements(const Points& polygon) {
  const Basis& basis = suitable_basis(polygon);
  const Points cell = support::with_middles(polygon);
  std::vector<TabulatedElement> elements(2);
  tabulate_quadratic(cell, dunavant_rule(4), basis, GradientCorrection::on, elements[0]);
  PolygonRule rule;
  make_vertex_rule(polygon, 6, rule);
  tabulate_quadratic(cell, rule, basis, GradientCorrection::on, elements[1]);
  return elements;
}

/// A quadratic displacement field, its stress for D, and the body force that balances it.
struct Field {
  Mat3 D = elasticity_matrix(3, 0.3, Plane::strain);
  static Vec2 displacement(const Vec2& x) {
    return {0.3 * x.x() * x.x() - x.x() * x.y() + 0.2 * x.y() - 1,
            0.7 * x.y() * x.y() + x.x() * x.y() - x.x()};
  }
  Vec3 stress(const Vec2& x) const {
    return D * Vec3(0.6 * x.x() - x.y(), 1.4 * x.y() + x.x(), -x.x() + 0.2 + x.y() - 1);
  }
  Vec2 body_force() const {
    const Vec3 by_x = stress({1, 0}) - stress({0, 0}), by_y = stress({0, 1}) - stress({0, 0});
    return -Vec2(by_x[0] + by_y[2], by_x[2] + by_y[1]);
  }
};

TEST(QuadraticElement, PassesTheQuadraticPatchTestByAnyRule) {
  const Field field;
  for (const Points& polygon : polygons())
    for (const TabulatedElement& element : elements(polygon)) {
      const Points nodes = support::with_middles(polygon);
      const Index n = nodes.cols();
      VectorXd d(2 * n), f, integrals;
      for (Index i = 0; i < n; ++i) d.segment<2>(2 * i) = Field::displacement(nodes.col(i));
      MatrixXd K;
      stiffness(element, field.D, K);
      shape_integrals(element, integrals);
      f = (field.body_force() * integrals.transpose()).reshaped();
      for (Index k = 0; k < n; k += 2) {  // tractions are linear, shape functions quadratic: Simpson's rule
        const Vec2 edge = nodes.col((k + 2) % n) - nodes.col(k), normal(edge.y(), -edge.x());
        for (const auto& [node, weight] : {std::pair(k, 1.), {k + 1, 4.}, {(k + 2) % n, 1.}}) {
          const Vec3 s = field.stress(nodes.col(node));
          f.segment<2>(2 * node) +=
              weight / 6 * Vec2(s[0] * normal.x() + s[2] * normal.y(), s[2] * normal.x() + s[1] * normal.y());
        }
      }
      EXPECT_LT((K * d - f).norm(), 1e-11 * K.norm()) << n / 2 << " corners";
    }
}

TEST(QuadraticElement, KeepsTheGradientsOfQuadraticFieldsAtEveryPoint) {
  const Field field;
  Tensors strain;
  for (const Points& polygon : polygons())
    for (const TabulatedElement& element : elements(polygon)) {
      const Points nodes = support::with_middles(polygon);
      VectorXd d(2 * nodes.cols());
      for (Index i = 0; i < nodes.cols(); ++i) d.segment<2>(2 * i) = Field::displacement(nodes.col(i));
      strains(element, d, strain);
      for (Index q = 0; q < element.n_points(); ++q)
        EXPECT_LT((field.D * strain.col(q) - field.stress(element.rule.points.col(q))).norm(), 1e-9);
    }
}

TEST(QuadraticElement, HasRigidMotionsAloneWithoutEnergy) {
  MatrixXd K;
  for (const Points& polygon : polygons())
    for (const TabulatedElement& element : elements(polygon)) {
      stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), K);
      const VectorXd energies = Eigen::SelfAdjointEigenSolver<MatrixXd>(K).eigenvalues();
      EXPECT_LT(energies.head<3>().cwiseAbs().maxCoeff(), 1e-11 * energies[energies.size() - 1]);
      EXPECT_GT(energies[3], 1e-4 * energies[energies.size() - 1]) << polygon.cols() << " corners";
    }
}

TEST(QuadraticElement, WeighsQuadraticPolynomialsExactly) {
  const Points square = support::points({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  TabulatedElement element;
  PolygonRule rule;
  make_adjoint_rule(square, 2, rule);
  tabulate_quadratic(support::with_middles(square), rule, suitable_basis(square), GradientCorrection::off,
                     element);
  const auto x = element.rule.points.row(0), y = element.rule.points.row(1);
  EXPECT_NEAR(element.rule.weights.sum(), 1, 1e-14);
  EXPECT_NEAR(x.cwiseProduct(x) * element.rule.weights, 1. / 3, 1e-14);
  EXPECT_NEAR(x.cwiseProduct(y) * element.rule.weights, 1. / 4, 1e-14);
}

TEST(QuadraticElement, MassAndConductionOfQuadraticFieldsAreExact) {
  const auto u = [](const Vec2& x) { return 1 + x.x() - 2 * x.y() + 0.5 * x.x() * x.x() - x.x() * x.y(); };
  const auto gradient = [](const Vec2& x) { return Vec2(1 + x.x() - x.y(), -2 - x.x()); };
  Mat2 conductivity;
  conductivity << 2, 0.3, 0.3, 1;
  MatrixXd M, K;
  for (const Points& polygon : polygons()) {
    const Points nodes = support::with_middles(polygon);
    const TabulatedElement element = elements(polygon)[0];
    double squares = 0, heat = 0;  // by the rule of degree 4, which is exact for both
    for (Index q = 0; q < element.n_points(); ++q) {
      const Vec2 x = element.rule.points.col(q);
      squares += element.rule.weights[q] * u(x) * u(x);
      heat += element.rule.weights[q] * gradient(x).dot(conductivity * gradient(x));
    }
    VectorXd values(nodes.cols());
    for (Index i = 0; i < nodes.cols(); ++i) values[i] = u(nodes.col(i));
    scalar_mass(element, M);
    diffusion(element, conductivity, K);
    EXPECT_NEAR(values.dot(M * values) / squares, 1, 1e-12) << polygon.cols() << " corners";
    EXPECT_NEAR(values.dot(K * values) / heat, 1, 1e-11) << polygon.cols() << " corners";
  }
}

/// Of concave cells the functions are not smooth at the corners: rules converge there, too, with more points.
TEST(QuadraticElement, IsTabulatedToATolerance) {
  const auto matrices = [](const TabulatedElement& element) {
    std::array<MatrixXd, 2> both;
    stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), both[0]);
    mass(element, both[1]);
    return both;
  };
  for (const Points& polygon : polygons()) {
    const Points cell = support::with_middles(polygon);
    const Basis& basis = suitable_basis(polygon);
    TabulatedElement element;
    ASSERT_TRUE(tabulate_quadratic_to_tolerance(cell, basis, 1e-8, GradientCorrection::off, element).met);
    const auto exact = matrices(element);
    for (const double tolerance : {1e-3, 1e-6}) {
      const ToleranceReport report =
          tabulate_quadratic_to_tolerance(cell, basis, tolerance, GradientCorrection::off, element);
      EXPECT_TRUE(report.met);
      EXPECT_EQ(report.n_points, element.n_points());
      const auto found = matrices(element);
      for (const std::size_t k : {0u, 1u})
        EXPECT_LT((found[k] - exact[k]).norm(), tolerance * exact[k].norm()) << polygon.cols() << " corners";
    }
  }
}

TEST(QuadraticElement, HasADefault) {
  const Points square = support::points({{0, 0}, {2, 0.1}, {1.8, 1}, {0, 1.2}}),
               pentagon = support::points({{0, 0}, {2, 0}, {2.2, 1}, {1, 1.7}, {0, 1}});
  TabulatedElement element, chosen;
  tabulate_quadratic(support::with_middles(square), element);
  EXPECT_EQ(element.n_points(), 9);
  tabulate_quadratic(support::with_middles(pentagon), element);
  tabulate_quadratic(support::with_middles(pentagon), dunavant_rule(4), suitable_basis(pentagon),
                     GradientCorrection::on, chosen);
  EXPECT_EQ(element.dx, chosen.dx);
  tabulate(square, element);
  EXPECT_EQ(element.n_points(), 4);
  tabulate(pentagon, element);
  tabulate(pentagon, dunavant_rule(4), suitable_basis(pentagon), GradientCorrection::on, chosen);
  EXPECT_EQ(element.dx, chosen.dx);
  const Points chevron = support::points({{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}});
  tabulate(chevron, element);
  EXPECT_NEAR(element.rule.weights.sum(), 1, 1e-14);
  EXPECT_THROW(tabulate_quadratic(chevron.leftCols(4), element), Error) << "without its midpoints";
}

}  // namespace
