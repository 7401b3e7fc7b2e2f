/// \file What every basis must do, as a GoogleTest suite to be instantiated for a basis of one's own.
///
/// For a class `MyBasis` derived from polyfem::Basis, in a test program linked with GTest::gtest_main:
///
///     #include <polyfem/testing/basis_properties.hpp>
///
///     struct MyPromises {
///       static const polyfem::Basis& basis() { static const MyBasis basis; return basis; }
///       static polyfem::BasisPromises promises() { return {.shapes = polyfem::SampleShapes::convex}; }
///     };
///     using namespace polyfem;
///     INSTANTIATE_TYPED_TEST_SUITE_P(My, BasisProperties, MyPromises);
#pragma once

#include <polyfem/core/error.hpp>
#include <polyfem/testing/basis_trial.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace polyfem {

/// \cond
TYPED_TEST_SUITE_P(BasisProperties);

TYPED_TEST_P(BasisProperties, HasANameAndRejectsNothingThatItIsFor) {
  EXPECT_FALSE(this->basis_.name().empty());
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    EXPECT_NO_THROW(require_suitable(this->basis_, polygon.vertices)) << polygon.name;
  });
}

/// Where it objects, it says so with its name and a vertex; where it does not, it is right.
TYPED_TEST_P(BasisProperties, RejectsOtherPolygonsOrIsRightThere) {
  WorstError worst;
  Points square(2, 4);
  square << 0, 1, 1, 0,  //
      0, 0, 1, 1;
  std::vector<SamplePolygon> others = concave_samples();
  others.push_back({"square, every other vertex on an edge", with_middle_vertices(square)});
  for (const SamplePolygon& polygon : others) {
    const std::optional<Rejection> rejection = this->basis_.find_rejection(polygon.vertices);
    if (!rejection) {
      this->expect_consistent(this->evaluate(polygon, this->places(polygon)), 1, worst);
      continue;
    }
    worst.see(0, 1, polygon, Vec2::Zero());
    EXPECT_GE(rejection->vertex, 0) << polygon.name;
    EXPECT_LT(rejection->vertex, polygon.vertices.cols()) << polygon.name;
    EXPECT_FALSE(rejection->reason.empty()) << polygon.name;
    try {
      require_suitable(this->basis_, polygon.vertices);
      ADD_FAILURE() << "no error on: " << polygon.name;
    } catch (const Error& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with(this->basis_.name())) << error.what();
    }
  }
}

TYPED_TEST_P(BasisProperties, ValuesSumToOne) {
  WorstError worst;
  this->for_each_point([&](const BasisSample& at, double) {
    for (Index q = 0; q < at.points.cols(); ++q)
      worst.see(std::abs(at.table.values.row(q).sum() - 1), this->sum_tolerance(at.polygon), at.polygon,
                at.x(q));
  });
}

TYPED_TEST_P(BasisProperties, ValuesReproduceThePosition) {
  WorstError worst;
  this->for_each_point([&](const BasisSample& at, double size) {
    for (Index q = 0; q < at.points.cols(); ++q) {
      const Vec2 error = (at.polygon.vertices.colwise() - at.x(q)) * at.table.values.row(q).transpose();
      worst.see(error.norm(), this->sum_tolerance(at.polygon) * size, at.polygon, at.x(q));
    }
  });
}

TYPED_TEST_P(BasisProperties, GradientsSumToZero) {
  WorstError worst;
  this->for_each_point([&](const BasisSample& at, double) {
    for (Index q = 0; q < at.points.cols(); ++q)
      worst.see(at.gradients(q).rowwise().sum().norm(),
                this->sum_tolerance(at.polygon) * at.largest_gradient(q), at.polygon, at.x(q));
  });
}

TYPED_TEST_P(BasisProperties, GradientsReproduceTheIdentity) {
  WorstError worst;
  this->for_each_point([&](const BasisSample& at, double size) {
    for (Index q = 0; q < at.points.cols(); ++q) {
      const Mat2 of_position = (at.polygon.vertices.colwise() - at.x(q)) * at.gradients(q).transpose();
      worst.see((of_position - Mat2::Identity()).norm(),
                2 * this->sum_tolerance(at.polygon) * size * at.largest_gradient(q), at.polygon, at.x(q));
    }
  });
}

TYPED_TEST_P(BasisProperties, IsOneAtItsVertexAndZeroAtTheOthers) {
  WorstError worst;
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const BasisSample at = this->evaluate(polygon, polygon.vertices);
    for (Index i = 0; i < at.points.cols(); ++i) {
      const auto unit = Eigen::RowVectorXd::Unit(at.points.cols(), i);
      const double error = (at.table.values.row(i) - unit).cwiseAbs().maxCoeff();
      worst.see(error, this->tolerance(polygon), polygon, at.x(i));
      worst.see(at.gradients(i).allFinite() ? 0 : 2, 1, polygon, at.x(i));
    }
  });
}

TYPED_TEST_P(BasisProperties, IsLinearAlongEdges) {
  WorstError worst_value, worst_slope;
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const Index n = polygon.vertices.cols();
    for (Index a = 0; a < n; ++a) {
      const Index b = (a + 1) % n;
      const Vec2 edge = polygon.vertices.col(b) - polygon.vertices.col(a);
      const BasisSample at = this->evaluate(polygon, edge_points(polygon.vertices, a));
      const VectorXd slope = VectorXd::Unit(n, b) - VectorXd::Unit(n, a);
      for (Index q = 0; q < 3; ++q) {
        const double s = static_cast<double>(q + 1) / 4;
        const VectorXd expected = (1 - s) * VectorXd::Unit(n, a) + s * VectorXd::Unit(n, b);
        const VectorXd values = at.table.values.row(q).transpose(),
                       slopes = at.gradients(q).transpose() * edge;
        worst_value.see((values - expected).cwiseAbs().maxCoeff(), this->tolerance(polygon), polygon,
                        at.x(q));
        const double allowed = 2 * this->tolerance(polygon) * edge.norm() * at.largest_gradient(q);
        worst_slope.see((slopes - slope).cwiseAbs().maxCoeff(), allowed, polygon, at.x(q));
      }
    }
  });
}

/// From 1e-3 to 1e-12 of the edge's length away: as the distance, not as some power of its inverse.
TYPED_TEST_P(BasisProperties, TendsFromInsideToWhatItIsOnTheEdge) {
  WorstError worst_value, worst_gradient;
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const Vec2 edge = polygon.vertices.col(2) - polygon.vertices.col(1), inward(-edge.y(), edge.x());
    const Points on_edge = edge_points(polygon.vertices, 1);
    const BasisSample limit = this->evaluate(polygon, on_edge);
    for (const double distance : {1e-3, 1e-6, 1e-9, 1e-12}) {
      const BasisSample at = this->evaluate(polygon, on_edge.colwise() + distance * inward);
      for (Index q = 0; q < 3; ++q) {
        const double scale = limit.largest_gradient(q), round_off = this->tolerance(polygon);
        const double step = (at.x(q) - limit.x(q)).norm();
        const double value = (at.table.values.row(q) - limit.table.values.row(q)).cwiseAbs().maxCoeff();
        const double gradient = (at.gradients(q) - limit.gradients(q)).cwiseAbs().maxCoeff();
        worst_value.see(value, 3 * step * scale + round_off, polygon, at.x(q));
        worst_gradient.see(gradient, (100 * distance + 2 * round_off) * scale, polygon, at.x(q));
      }
    }
  });
}

/// Fourth order differences, with a second step so short that it does not cross a kink by chance.
TYPED_TEST_P(BasisProperties, GradientsAreTheDifferencesOfTheValues) {
  WorstError worst;
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const BasisSample at = this->evaluate(polygon, inner_points(polygon.vertices, 4));
    for (Index q = 0; q < at.points.cols(); ++q) {
      double error = std::numeric_limits<double>::infinity();
      for (const double fraction : {2e-3, 1e-6}) {
        const double h = fraction * distance_to_boundary(polygon.vertices, at.x(q));
        Points around(2, 8), differences(2, polygon.vertices.cols());
        around << h, -h, 2 * h, -2 * h, 0, 0, 0, 0,  //
            0, 0, 0, 0, h, -h, 2 * h, -2 * h;
        const MatrixXd N = this->evaluate(polygon, around.colwise() + at.x(q)).table.values;
        for (Index axis = 0; axis < 2; ++axis)
          differences.row(axis) = (8 * (N.row(4 * axis) - N.row(4 * axis + 1)) -  //
                                   (N.row(4 * axis + 2) - N.row(4 * axis + 3))) /
                                  (12 * h);
        error = std::min(error, (differences - at.gradients(q)).cwiseAbs().maxCoeff());
      }
      worst.see(error, (1e-8 + 1e5 * this->tolerance(polygon)) * at.largest_gradient(q), polygon, at.x(q));
    }
  });
}

TYPED_TEST_P(BasisProperties, FollowsTranslations) {
  for (const double distance : {1., 1e4, 1e8})
    this->expect_equal_when_mapped(Mat2::Identity(), Vec2(distance, -distance));
}

TYPED_TEST_P(BasisProperties, FollowsTurnsAndReflections) {
  Mat2 A;
  A << 0, -1, 1, 0;
  this->expect_equal_when_mapped(A, Vec2::Zero());
  A << 0.75, -1, 1, 0.75;  // by 53 degrees, and larger by 5/4
  this->expect_equal_when_mapped(A, Vec2::Zero());
}

TYPED_TEST_P(BasisProperties, FollowsChangesOfScale) {
  for (const int exponent : {-20, -1, 20})
    this->expect_equal_when_mapped(std::ldexp(1., exponent) * Mat2::Identity(), Vec2::Zero());
}

TYPED_TEST_P(BasisProperties, FollowsAffineMapsIfItPromisesTo) {
  if (!this->promises_.affine) GTEST_SKIP() << this->basis_.name() << " does not promise it";
  Mat2 A;
  A << 1.25, 0.5, -0.25, 0.75;
  this->expect_equal_when_mapped(A, Vec2(3, -2));
}

TYPED_TEST_P(BasisProperties, DoesNotDependOnWhichVertexIsTheFirst) {
  WorstError worst_value, worst_gradient;
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const Index n = polygon.vertices.cols();
    const BasisSample at = this->evaluate(polygon, this->places(polygon));
    SamplePolygon turned = polygon;
    for (Index i = 0; i < n; ++i) turned.vertices.col(i) = polygon.vertices.col((i + n / 2) % n);
    const BasisSample other = this->evaluate(turned, at.points);
    for (Index q = 0; q < at.points.cols(); ++q)
      for (Index i = 0; i < n; ++i) {
        const Index k = (i + n / 2) % n;
        worst_value.see(std::abs(other.table.values(q, i) - at.table.values(q, k)),
                        2 * this->tolerance(polygon), polygon, at.x(q));
        if (q < this->n_smooth_points)
          worst_gradient.see((other.gradients(q).col(i) - at.gradients(q).col(k)).norm(),
                             4 * this->tolerance(polygon) * at.largest_gradient(q), polygon, at.x(q));
      }
  });
}

/// An edge of length l costs the digits of l, no more.
TYPED_TEST_P(BasisProperties, StandsTinyEdges) {
  if (this->promises_.largest_n < 5) GTEST_SKIP() << "the polygons have five vertices";
  WorstError worst;
  for (const double length : {1e-2, 1e-4, 1e-6, 1e-8}) {
    SamplePolygon polygon{"unit square with a tiny edge across a corner", Points(2, 5)};
    polygon.vertices << 0, 1, 1, 1 - length, 0,  //
        0, 0, 1 - length, 1, 1;
    const Vec2 corner(1, 1);
    Points points(2, 8);
    points << inner_points(polygon.vertices, 4), corner - Vec2(length, length),
        edge_points(polygon.vertices, 2);
    this->expect_consistent(this->evaluate(polygon, points), 1 / length, worst);
  }
}

/// A corner that turns by an angle t may cost the digits of t, no more.
TYPED_TEST_P(BasisProperties, StandsNearlyStraightCorners) {
  if (this->promises_.largest_n < 5) GTEST_SKIP() << "the polygons have five vertices";
  WorstError worst;
  for (const double turn : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    SamplePolygon polygon{"unit square with a nearly straight corner", Points(2, 5)};
    polygon.vertices << 0, 0.5, 1, 1, 0,  //
        0, -turn / 4, 0, 1, 1;
    Points points(2, 9);
    points << inner_points(polygon.vertices, 4), edge_points(polygon.vertices, 0),
        polygon.vertices.leftCols(2);
    this->expect_consistent(this->evaluate(polygon, points), 1 / turn, worst);
  }
}

TYPED_TEST_P(BasisProperties, OnePointAloneIsTheSameAsAmongMany) {
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const BasisSample all = this->evaluate(polygon, this->places(polygon));
    ShapeValues alone;
    for (Index q = 0; q < all.points.cols(); ++q) {
      this->basis_(polygon.vertices, all.points.col(q), alone);
      ASSERT_EQ(alone.values.transpose(), all.table.values.row(q)) << polygon.name << ", point " << q;
      ASSERT_EQ(alone.gradients, all.gradients(q)) << polygon.name << ", point " << q;
    }
  });
}

TYPED_TEST_P(BasisProperties, ReusesTheStorageOfTheTable) {
  this->for_each_polygon([&](const SamplePolygon& polygon) {
    const Points points = this->places(polygon);
    BasisSample at = this->evaluate(polygon, points);
    const double *values = at.table.values.data(), *dx = at.table.dx.data(), *dy = at.table.dy.data();
    this->basis_.evaluate(polygon.vertices, points, at.table);
    ASSERT_TRUE(at.table.values.data() == values && at.table.dx.data() == dx && at.table.dy.data() == dy)
        << polygon.name;
  });
}

REGISTER_TYPED_TEST_SUITE_P(BasisProperties, HasANameAndRejectsNothingThatItIsFor,
                            RejectsOtherPolygonsOrIsRightThere, ValuesSumToOne, ValuesReproduceThePosition,
                            GradientsSumToZero, GradientsReproduceTheIdentity,
                            IsOneAtItsVertexAndZeroAtTheOthers, IsLinearAlongEdges,
                            TendsFromInsideToWhatItIsOnTheEdge, GradientsAreTheDifferencesOfTheValues,
                            FollowsTranslations, FollowsTurnsAndReflections, FollowsChangesOfScale,
                            FollowsAffineMapsIfItPromisesTo, DoesNotDependOnWhichVertexIsTheFirst,
                            StandsTinyEdges, StandsNearlyStraightCorners, OnePointAloneIsTheSameAsAmongMany,
                            ReusesTheStorageOfTheTable);
/// \endcond

}  // namespace polyfem
