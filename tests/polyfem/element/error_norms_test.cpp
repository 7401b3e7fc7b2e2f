#include <polyfem/basis/wachspress.hpp>
#include <polyfem/element/error_norms.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace polyfem;

namespace {

class ErrorNorms : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    tabulate(polygon_, collapsed_gauss_rule(4, 4), wachspress, GradientCorrection::off, element_);
  }
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  TabulatedElement element_;
};
INSTANTIATE_TEST_SUITE_P(Vertices, ErrorNorms, testing::Values(3, 4, 5, 8));

TEST_P(ErrorNorms, OfTheElementsOwnLinearFieldsAreZero) {
  Mat2 G;
  G << 0.3, -0.2, 0.5, 0.1;
  const VectorXd u = polygon_.transpose() * Vec2(1, 2), d = (G * polygon_).reshaped();
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  Tensors strain;
  strains(element_, d, strain);
  EXPECT_LT(squared_error(element_, u, [](const Vec2& x) { return x.x() + 2 * x.y(); }), 1e-27);
  EXPECT_LT(squared_displacement_error(element_, d, [&](const Vec2& x) { return Vec2(G * x); }), 1e-27);
  EXPECT_LT(squared_gradient_error(element_, Mat2::Identity(), u, [](const Vec2&) { return Vec2(1, 2); }),
            1e-24);
  EXPECT_LT(squared_energy_error(element_, D, strain, [](const Vec2&) { return Vec3(0.3, 0.1, 0.3); }),
            1e-24);
}

TEST_P(ErrorNorms, OfZeroAreTheNormsOfTheExactFunction) {
  const VectorXd zero = VectorXd::Zero(n_), zero_d = VectorXd::Zero(2 * n_);
  const AreaMoments moments = area_moments(polygon_);  // about the centroid, which is the origin
  Mat2 k;
  k << 2, 0.3, 0.3, 1;
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  const auto x_of = [](const Vec2& x) { return x.x(); };
  const auto position = [](const Vec2& x) { return x; };
  const auto strain = [](const Vec2& x) { return Vec3(x.x(), 0, 0); };
  const double xx = moments.second(0, 0);
  EXPECT_NEAR(squared_error(element_, zero, x_of), xx, 1e-14);
  EXPECT_NEAR(squared_displacement_error(element_, zero_d, position), moments.second.trace(), 1e-14);
  EXPECT_NEAR(squared_gradient_error(element_, k, zero, position), k.cwiseProduct(moments.second).sum(),
              1e-14);
  EXPECT_NEAR(squared_energy_error(element_, D, Tensors::Zero(3, element_.n_points()), strain), D(0, 0) * xx,
              1e-14);
}

}  // namespace
