#include <polyfem/basis/mean_value.hpp>
#include <polyfem/basis/wachspress.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/element/loads.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <limits>

using namespace polyfem;

namespace {

class Loads : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    tabulate(polygon_, hammer_rule(5), wachspress, GradientCorrection::on, element_);
    for (double& value : d_) value = support::uniform(-1, 1, random_);
  }
  Vec2 displacement(const Vec2& x) const {
    ShapeValues shape;
    wachspress(polygon_, x, shape);
    return d_.reshaped(2, n_) * shape.values;
  }
  int n_ = GetParam();
  std::mt19937 random_{static_cast<unsigned>(n_)};
  Points polygon_ = support::random_convex_polygon(n_, random_);
  TabulatedElement element_;
  VectorXd d_ = VectorXd(2 * n_), f_ = VectorXd::Zero(2 * n_);
};
INSTANTIATE_TEST_SUITE_P(Vertices, Loads, testing::Values(3, 4, 5, 8, 12));

/// Sum of the forces and of their moments about the origin.
Vec3 resultant(const Points& polygon, const VectorXd& f) {
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < polygon.cols(); ++i) {
    const Vec2 force = f.segment<2>(2 * i);
    sum += Vec3(force.x(), force.y(), cross(polygon.col(i), force));
  }
  return sum;
}

TEST_P(Loads, BodyForceHasTheResultantOfTheWeight) {
  const Vec2 b(0.3, -9.81);
  body_force(element_, b, f_);
  const AreaMoments moments = area_moments(polygon_);
  const Vec2 weight = moments.area * b;
  EXPECT_LT((resultant(polygon_, f_) - Vec3(weight.x(), weight.y(), cross(moments.centroid, weight))).norm(),
            1e-13);
}

TEST_P(Loads, BodyForceThatVariesDoesItsWork) {
  const auto b = [](const Vec2& x) { return Vec2(std::sin(3 * x.y()), x.x() * x.x()); };
  body_force(element_, b, f_);
  double work = 0;
  for (Index q = 0; q < element_.n_points(); ++q) {
    const Vec2 x = element_.rule.points.col(q);
    work += element_.rule.weights[q] * b(x).dot(displacement(x));
  }
  EXPECT_NEAR(f_.dot(d_), work, 1e-14);
  VectorXd uniform = VectorXd::Zero(2 * n_), by_function = uniform;
  body_force(element_, Vec2(1, 2), uniform);
  body_force(
      element_, [](const Vec2&) { return Vec2(1, 2); }, by_function);
  EXPECT_LT((uniform - by_function).norm(), 1e-14);
}

TEST_P(Loads, EdgeTractionDoesItsWorkOnEveryEdge) {
  const TriangleRule gauss = collapsed_gauss_rule(1, 10);  // its points along a side are Gauss points
  const Vec2 first(1, -2), last(-3, 0.5);
  for (Index edge = 0; edge < n_; ++edge) {
    const Vec2 start = polygon_.col(edge), along = polygon_.col((edge + 1) % n_) - start;
    double work = 0;
    for (Index q = 0; q < gauss.weights.size(); ++q) {
      const double s = gauss.points(2, q) / (gauss.points(1, q) + gauss.points(2, q));
      work +=
          gauss.weights[q] * along.norm() * ((1 - s) * first + s * last).dot(displacement(start + s * along));
    }
    f_.setZero();
    edge_traction(polygon_, edge, first, last, f_);
    EXPECT_NEAR(f_.dot(d_), work, 1e-13);
    VectorXd by_function = VectorXd::Zero(2 * n_);
    edge_traction(
        polygon_, edge,
        [&](const Vec2& x) {
          const double s = (x - start).dot(along) / along.squaredNorm();
          return Vec2((1 - s) * first + s * last);
        },
        by_function);
    EXPECT_LT((by_function - f_).norm(), 1e-14);
  }
}

TEST_P(Loads, TractionsOfAUniformStressAreTheForcesOfThatStress) {
  const Vec3 stress(2, -1, 0.5);
  Mat2 sigma;
  sigma << stress[0], stress[2], stress[2], stress[1];
  for (Index k = 0; k < n_; ++k) {
    const Vec2 edge = (polygon_.col((k + 1) % n_) - polygon_.col(k)).normalized();
    const Vec2 traction = sigma * Vec2(edge.y(), -edge.x());
    edge_traction(polygon_, k, traction, traction, f_);
  }
  initial_stress(element_, stress.replicate(1, element_.n_points()), f_);  // adds what balances the tractions
  EXPECT_LT(f_.norm(), 1e-13);
}

TEST_P(Loads, QuarticTractionIsExact) {
  edge_traction(
      polygon_, 1, [&](const Vec2& x) { return Vec2(std::pow((x - polygon_.col(1)).norm(), 4), 0); }, f_);
  const double length = (polygon_.col(2) - polygon_.col(1)).norm();
  EXPECT_NEAR(f_[2], std::pow(length, 5) * (1. / 5 - 1. / 6), 1e-15);
  EXPECT_NEAR(f_[2 * (2 % n_)], std::pow(length, 5) / 6, 1e-15);
}

TEST_P(Loads, PointLoadDoesTheWorkOfItsPoint) {
  const Vec2 force(2, -3);
  for (int trial = 0; trial < 20; ++trial) {
    const Vec2 x = support::random_point_in(polygon_, random_);
    f_.setZero();
    point_load(polygon_, wachspress, x, force, f_);
    EXPECT_NEAR(f_.dot(d_), force.dot(displacement(x)), 1e-13);
    EXPECT_LT((resultant(polygon_, f_) - Vec3(force.x(), force.y(), cross(x, force))).norm(), 1e-13);
  }
}

TEST_P(Loads, PointLoadAtAVertexIsAllAtThatVertex) {
  for (Index i = 0; i < n_; ++i) {
    f_.setZero();
    point_load(polygon_, mean_value, polygon_.col(i), Vec2(1, 2), f_);
    EXPECT_EQ(f_[2 * i], 1);
    EXPECT_EQ(f_[2 * i + 1], 2);
    EXPECT_EQ(f_.cwiseAbs().sum(), 3);
  }
}

TEST_P(Loads, PointLoadOutsideIsRefusedButNotForRoundOff) {
  const Vec2 middle = (polygon_.col(0) + polygon_.col(1)) / 2, edge = polygon_.col(1) - polygon_.col(0);
  const Vec2 outward = Vec2(edge.y(), -edge.x()).normalized();
  EXPECT_NO_THROW(point_load(polygon_, wachspress, middle + 1e-16 * outward, Vec2(1, 0), f_));
  try {
    point_load(polygon_, wachspress, middle + 0.25 * outward, Vec2(1, 0), f_);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("outside the polygon by 0.25"), std::string::npos)
        << error.what();
  }
}

TEST_P(Loads, PointLoadFarFromTheOriginMayBeOutsideByTheRoundOffOfItsCoordinatesOnly) {
  const double offset = 1e8;
  const Points far = polygon_.array() + offset;
  const Vec2 middle = (far.col(0) + far.col(1)) / 2, edge = far.col(1) - far.col(0);
  const Vec2 outward = Vec2(edge.y(), -edge.x()).normalized();
  EXPECT_NO_THROW(point_load(far, wachspress, middle, Vec2(1, 0), f_));
  EXPECT_NO_THROW(point_load(far, wachspress, middle + 3e-8 * outward, Vec2(1, 0), f_));
  EXPECT_THROW(point_load(far, wachspress, middle + 1e-6 * outward, Vec2(1, 0), f_), Error);
}

TEST_P(Loads, PointLoadThatIsNowhereIsRefused) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const Basis* basis : std::initializer_list<const Basis*>{&wachspress, &mean_value}) {
      EXPECT_THROW(point_load(polygon_, *basis, Vec2(x, 0.5), Vec2(1, 0), f_), Error);
      EXPECT_THROW(point_load(polygon_, *basis, Vec2(0.5, x), Vec2(1, 0), f_), Error);
    }
}

TEST_P(Loads, InitialStrainIsRelievedByTheDisplacementsThatHaveIt) {
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  const Vec3 strain(0.3, -0.1, 0.2);
  Mat2 G;
  G << 0.3, 0.1, 0.1, -0.1;
  const Points u = G * polygon_;
  MatrixXd K;
  stiffness(element_, D, K);
  initial_stress(element_, (-D * strain).replicate(1, element_.n_points()), f_);
  EXPECT_LT((K * u.reshaped() - f_).norm(), 1e-13);
}

TEST_P(Loads, InitialStressAtPointsIsMinusItsForces) {
  const Tensors stress = Tensors::Random(3, element_.n_points());
  VectorXd forces(2 * n_);
  stress_forces(element_, stress, forces);
  initial_stress(element_, stress, f_);
  EXPECT_EQ(f_, -forces);
}

TEST_P(Loads, AddUp) {
  body_force(element_, Vec2(1, 2), f_);
  const VectorXd once = f_;
  body_force(element_, Vec2(1, 2), f_);
  EXPECT_EQ(f_, 2 * once);
}

}  // namespace
