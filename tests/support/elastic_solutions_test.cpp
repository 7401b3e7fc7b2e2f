// The closed forms obey Hooke's law and balance their body force, by central differences; their boundaries
// are as told.
#include <tests/support/elastic_solutions.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace polyfem;

namespace {

struct Case {
  const char* name;
  support::ElasticSolution solution;
};

class ElasticSolutionTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Fields, ElasticSolutionTest,
    testing::Values(Case{"Manufactured", support::manufactured_solution(2, 0.3)},
                    Case{"Cantilever", support::cantilever_solution(2, 0.3, 2, 1.5, 0.7)},
                    Case{"NearlyIncompressible", support::cantilever_solution(2, 0.4999, 2, 1.5, 0.7)},
                    Case{"Hole", support::hole_solution(2, 0.3, 0.4, 0.7)}),
    [](const auto& test) { return test.param.name; });

const std::vector<Vec2> points{{0.3, 0.45}, {0.7, -0.2}, {1.1, 0.6}, {0.5, 0.}};
constexpr double h = 1e-4;

TEST_P(ElasticSolutionTest, StressIsHookesOfTheDisplacements) {
  const auto& [young, poisson, plane, u, stress, b] = GetParam().solution;
  for (const Vec2& p : points) {
    const Vec2 u_x = (u(p + Vec2(h, 0)) - u(p - Vec2(h, 0))) / (2 * h);
    const Vec2 u_y = (u(p + Vec2(0, h)) - u(p - Vec2(0, h))) / (2 * h);
    const Vec3 strain(u_x.x(), u_y.y(), u_x.y() + u_y.x());
    const Vec3 difference = stress(p) - elasticity_matrix(young, poisson, plane) * strain;
    const double scale = elasticity_matrix(young, poisson, plane).norm();
    EXPECT_LT(difference.norm(), 1e-6 * scale) << p.transpose();
  }
}

TEST_P(ElasticSolutionTest, StressBalancesTheBodyForce) {
  const support::ElasticSolution& field = GetParam().solution;
  for (const Vec2& p : points) {
    const Vec3 s_x = (field.stress(p + Vec2(h, 0)) - field.stress(p - Vec2(h, 0))) / (2 * h);
    const Vec3 s_y = (field.stress(p + Vec2(0, h)) - field.stress(p - Vec2(0, h))) / (2 * h);
    Vec2 residual(s_x[0] + s_y[2], s_x[2] + s_y[1]);
    if (field.body_force) residual += field.body_force(p);
    EXPECT_LT(residual.norm(), 2e-6 * (1 + field.stress(p).norm())) << p.transpose();
  }
}

TEST(ElasticSolutions, CantileverIsLoadedAtItsEndAlone) {
  const auto beam = support::cantilever_solution(2, 0.3, 2, 1.5, 0.7);
  EXPECT_LT(support::traction(beam.stress({0.6, 0.75}), {0, 1}).norm(), 1e-15);
  EXPECT_EQ(beam.stress({2, 0.3})[0], 0);
  double force = 0;  // Simpson's rule is exact for the parabola
  for (const auto& [y, weight] : {std::pair(-0.75, 1. / 6), {0., 4. / 6}, {0.75, 1. / 6}})
    force += 1.5 * weight * support::traction(beam.stress({2, y}), {1, 0}).y();
  EXPECT_NEAR(force, 0.7, 1e-15);
  EXPECT_EQ(beam.displacement({0, 0}).norm(), 0);
}

TEST(ElasticSolutions, HoleIsFreeOfTractionAndTriplesTheTension) {
  const auto plate = support::hole_solution(2, 0.3, 0.4, 0.7);
  for (const double angle : {0., 0.4, 1.3}) {
    const Vec2 n(std::cos(angle), std::sin(angle));
    EXPECT_LT(support::traction(plate.stress(0.4 * n), n).norm(), 1e-14);
  }
  EXPECT_NEAR(plate.stress({0, 0.4})[0], 3 * 0.7, 1e-13);
  EXPECT_LT((plate.stress({300, 400}) - Vec3(0.7, 0, 0)).norm(), 1e-5);
}

}  // namespace
