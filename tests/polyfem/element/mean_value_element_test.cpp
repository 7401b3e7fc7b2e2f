// Mean value functions of a vertex at an edge.
#include <polyfem/basis/mean_value.hpp>
#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class VertexNearAnEdge : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Distance, VertexNearAnEdge, testing::Values(1e-3, 1e-6, 1e-12, 0, -1e-12, -1e-3));

/// Wachspress functions would give this vertex a stiffness of 0.122 / distance, and coarse rules none at all.
TEST_P(VertexNearAnEdge, IsAsStiffAsOthers) {
  Points square(2, 5);
  square << 0, 0.5, 1, 1, 0,  //
      0, -GetParam(), 0, 1, 1;
  TabulatedElement element;
  MatrixXd K, M;
  tabulate(square, collapsed_gauss_rule(10, 10), mean_value, GradientCorrection::on, element);
  stiffness(element, elasticity_matrix(1, 0.3, Plane::strain), K);
  mass(element, M);
  const Definiteness definiteness = judge(K, M);
  EXPECT_TRUE(definiteness.definite());
  EXPECT_LE(1 / definiteness.least_stiffness, 20);
  EXPECT_NEAR(K(3, 3), 1, 0.02);
}

}  // namespace
