#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/stress_recovery.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

using namespace polyfem;

namespace {

class Tabulate : public testing::TestWithParam<int> {
 protected:
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  TabulatedElement element_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, Tabulate, testing::Values(3, 4, 5, 8, 12, 20));

/// The integral over the boundary of N_i n, edge by edge: half of the length times the normal to each end.
Points boundary_integrals(const Points& polygon) {
  Points integrals = Points::Zero(2, polygon.cols());
  for (Index k = 0; k < polygon.cols(); ++k) {
    const Index next = (k + 1) % polygon.cols();
    const Vec2 edge = polygon.col(next) - polygon.col(k);
    const Vec2 outward(edge.y(), -edge.x());
    integrals.col(k) += outward / 2;
    integrals.col(next) += outward / 2;
  }
  return integrals;
}

Points integrals_of_gradients(const TabulatedElement& element) {
  Points integrals(2, element.n_vertices());
  integrals.row(0) = element.rule.weights.transpose() * element.dx;
  integrals.row(1) = element.rule.weights.transpose() * element.dy;
  return integrals;
}

TEST_P(Tabulate, HoldsTheBasisAtThePointsOfTheFan) {
  tabulate(polygon_, hammer_rule(3), wachspress, GradientCorrection::off, element_);
  ASSERT_EQ(element_.n_vertices(), n_);
  ASSERT_EQ(element_.n_points(), 4 * n_);
  EXPECT_NEAR(element_.area, area_moments(polygon_).area, 1e-14);
  ShapeValues shape;
  for (Index q = 0; q < element_.n_points(); ++q) {
    wachspress(polygon_, element_.rule.points.col(q), shape);
    EXPECT_EQ(element_.values.row(q), shape.values.transpose());
    EXPECT_EQ(element_.dx.row(q), shape.gradients.row(0));
    EXPECT_EQ(element_.dy.row(q), shape.gradients.row(1));
  }
}

TEST_P(Tabulate, CorrectionMakesTheDivergenceTheoremHoldForAnyRule) {
  const Points exact = boundary_integrals(polygon_);
  for (int degree = 1; degree <= 5; ++degree) {
    tabulate(polygon_, hammer_rule(degree), wachspress, GradientCorrection::on, element_);
    EXPECT_LT((integrals_of_gradients(element_) - exact).cwiseAbs().maxCoeff(), 1e-15 * n_);
  }
}

TEST_P(Tabulate, CorrectionVanishesAsTheRuleConverges) {
  TabulatedElement corrected;
  double previous = 1e9;
  for (const int points : {4, 8, 16, 32}) {
    tabulate(polygon_, collapsed_gauss_rule(points, points, 2), wachspress, GradientCorrection::off,
             element_);
    tabulate(polygon_, collapsed_gauss_rule(points, points, 2), wachspress, GradientCorrection::on,
             corrected);
    const double shift = (corrected.dx - element_.dx).cwiseAbs().maxCoeff();
    EXPECT_LT(shift, std::max(previous / 2, 1e-13));
    previous = shift;
  }
  EXPECT_LT(previous, 1e-6);  // of gradients of order 1 to 100: the fine rule's own error for n = 20
}

TEST_P(Tabulate, CorrectionKeepsTheSumOfGradientsAndTheIdentity) {
  tabulate(polygon_, hammer_rule(3), wachspress, GradientCorrection::on, element_);
  for (Index q = 0; q < element_.n_points(); ++q) {
    Points gradients(2, n_);
    gradients << element_.dx.row(q), element_.dy.row(q);
    EXPECT_LT(gradients.rowwise().sum().norm(), 1e-13);
    EXPECT_LT((polygon_ * gradients.transpose() - Mat2::Identity()).norm(), 1e-13);
  }
}

/// What Wachspress functions say on the way by which the polygon comes in; empty when they take it.
std::string complaint(const std::function<void()>& use) {
  try {
    use();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(WachspressOfAnUnsuitablePolygon, IsRefusedWithVertexAndCureByEveryWayIn) {
  Points dart(2, 5), straight(2, 5);
  dart << 0, 2, 2, 1, 0,  //
      0, 0, 2, 0.5, 2;
  straight << 0, 2, 2, 1, 0,  //
      0, 0, 2, 2, 2;
  for (const Points& polygon : {dart, straight}) {
    TabulatedElement element;
    ShapeValues shape;
    const Vec2 x(0.5, 0.4);
    const VectorXd d = VectorXd::Ones(2 * polygon.cols());
    VectorXd f = d;
    const std::vector<std::function<void()>> ways{
        [&] { tabulate(polygon, hammer_rule(2), wachspress, GradientCorrection::on, element); },
        [&] { wachspress.evaluate(polygon, x, element); }, [&] { wachspress(polygon, x, shape); },
        [&] { strain_at(polygon, wachspress, d, x); },
        [&] { point_load(polygon, wachspress, x, Vec2(1, 0), f); }};
    for (const auto& way : ways)
      EXPECT_NE(complaint(way).find("wachspress: vertex 3"
                                    " does not turn left, which Wachspress functions need: use mean_value"),
                std::string::npos)
          << complaint(way);
    EXPECT_EQ(f, d);
  }
}

}  // namespace
