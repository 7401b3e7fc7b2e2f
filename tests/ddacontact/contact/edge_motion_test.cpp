#include <ddacontact/contact/contact.hpp>
#include <ddacontact/contact/kinematics.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>

using namespace ddacontact;

namespace {

using Vec6 = Eigen::Matrix<double, 6, 1>;

Vec6 coordinates(const VertexEdgePositions& positions) {
  return (Vec6() << positions.i, positions.j, positions.k).finished();
}
Vec6 components(const VertexEdgeGradient& gradient) {
  return (Vec6() << gradient.i, gradient.j, gradient.k).finished();
}
VertexEdgePositions place_at(const Vec6& x) {
  return {x.head<2>(), x.segment<2>(2), x.tail<2>()};
}

VertexEdgeGradient gradient_at(const Vec6& x) {
  return {x.head<2>(), x.segment<2>(2), x.tail<2>()};
}

GapAndSlip at_rest(const Vec6& x, double lock) {
  return gap_and_slip(place_at(x), place_at(Vec6::Zero()), lock, Directions::of_end);
}

/// The gap (lock is not used) or the slip, with its two gradients.
struct Measure {
  bool is_gap;
  double lock;

  double value(const Vec6& x) const { return is_gap ? gap(place_at(x)) : at_rest(x, lock).slip; }
  Vec6 gradient(const Vec6& x) const {
    return components(is_gap ? at_rest(x, lock).by_gap : at_rest(x, lock).by_slip);
  }
  Vec6 mean_gradient(const Vec6& x0, const Vec6& x1) const {
    const GapAndSlip mean = gap_and_slip(place_at(x0), place_at(x1 - x0), lock, Directions::mean);
    return components(is_gap ? mean.by_gap : mean.by_slip);
  }
  VertexEdgeForm first_order(const VertexEdgePositions& positions) const {
    return is_gap ? gap_form(positions) : slip_form(positions, lock);
  }
  /// The same by the definition, for coordinates of any number type.
  template <class Number>
  Number defined(const Eigen::Matrix<Number, 6, 1>& x) const {
    const Number a_x = x[4] - x[2], a_y = x[5] - x[3], l = std::sqrt(a_x * a_x + a_y * a_y);
    const Number share = is_gap ? 0 : lock, b_x = x[0] - x[2] - share * a_x, b_y = x[1] - x[3] - share * a_y;
    return is_gap ? (a_y * b_x - a_x * b_y) / l : (a_x * b_x + a_y * b_y) / l;
  }
};

Vec2 random_vector(double size, std::mt19937& random) {
  return support::uniform(0, size, random) * support::random_direction(random);
}

/// An edge of length 0.5 to 2 and a vertex over it, or a little beyond its ends, or next to it.
Vec6 random_place(double largest_gap, std::mt19937& random) {
  const Vec2 t = support::random_direction(random), a = support::uniform(0.5, 2, random) * t;
  const Vec2 j = random_vector(1, random);
  const Vec2 i = j + support::uniform(-0.2, 1.2, random) * a +
                 support::uniform(-largest_gap, largest_gap, random) * Vec2(t.y(), -t.x());
  return coordinates({i, j, j + a});
}

Mat2 rotation(double angle) {
  return (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}
Vec6 rotated(double angle, const Vec6& x) {
  Vec6 y;
  y.reshaped(2, 3) = rotation(angle) * x.reshaped(2, 3);
  return y;
}
Vec6 translated(const Vec2& u, const Vec6& x) {
  return x + u.replicate<3, 1>();
}

/// Turns by up to 2, stretches by up to 2 in any direction, moves, and moves the vertex by itself.
Vec6 randomly_moved(const Vec6& x, std::mt19937& random) {
  const Mat2 axes = rotation(support::uniform(0, 3, random));
  const Vec2 stretches(support::uniform(0.5, 2, random), support::uniform(0.5, 2, random));
  const Mat2 F = rotation(support::uniform(-2, 2, random)) * axes * stretches.asDiagonal() * axes.transpose();
  Vec6 y;
  y.reshaped(2, 3) = F * x.reshaped(2, 3);
  y.head<2>() += random_vector(0.5, random);
  return translated(random_vector(3, random), y);
}

double moment(const Vec6& x, const Vec6& force) {
  double sum = 0;
  for (int p = 0; p < 6; p += 2) sum += cross(x.segment<2>(p), force.segment<2>(p));
  return sum;
}

std::vector<PointMap::Term> random_terms(std::mt19937& random) {
  std::vector<PointMap::Term> terms;
  for (int u = 0; u < PointMap::capacity; ++u) terms.push_back({u, random_vector(1, random)});
  return terms;
}

class EdgeMotion : public testing::TestWithParam<Measure> {
 protected:
  const Measure measure = GetParam();
  std::mt19937 random{7};
};

std::string measure_name(const testing::TestParamInfo<Measure>& info) {
  return info.param.is_gap ? "Gap" : "Slip" + std::to_string(info.index);
}

}  // namespace

INSTANTIATE_TEST_SUITE_P(OfAVertexAndAnEdge, EdgeMotion,
                         testing::Values(Measure{true, 0}, Measure{false, 0}, Measure{false, 0.7},
                                         Measure{false, 1.1}),
                         measure_name);

TEST(EdgeMotion, GapIsNegativeInsideACounterClockwiseBlockAndSlipGrowsAlongItsEdge) {
  const VertexEdgePositions inside{{0.5, 0.1}, {0, 0}, {2, 0}}, outside{{0.5, -0.1}, {0, 0}, {2, 0}};
  EXPECT_DOUBLE_EQ(gap(inside), -0.1);
  EXPECT_DOUBLE_EQ(gap(outside), 0.1);
  EXPECT_DOUBLE_EQ(at_rest(coordinates(inside), 0).slip, 0.5);
  EXPECT_DOUBLE_EQ(at_rest(coordinates(inside), 0.75).slip, -1);
}

TEST_P(EdgeMotion, ValuesAreGoodToAFewRoundingsOfTheEdge) {
  for (int trial = 0; trial < 200; ++trial) {
    const Vec6 x = random_place(trial % 2 ? 1e-9 : 1, random);
    const double size = (x.segment<2>(4) - x.segment<2>(2)).norm() + (x.head<2>() - x.segment<2>(2)).norm();
    const auto reference = measure.defined<long double>(x.cast<long double>());
    EXPECT_NEAR(measure.value(x), static_cast<double>(reference), 4e-16 * size);
  }
}

/// Coordinates whose products are exact.
TEST(EdgeMotion, AVertexOnTheLineHasAGapOfExactlyZero) {
  for (int n = -3; n < 10; ++n)
    EXPECT_EQ(gap({Vec2(5, 7) + n * Vec2(3, 11), {5, 7}, Vec2(5, 7) + 7 * Vec2(3, 11)}), 0);
}

TEST_P(EdgeMotion, NothingDependsOnWhereTheOriginIs) {
  const double unit = std::ldexp(1, -20);
  const auto on_lattice = [&](const Vec6& x) { return ((x / unit).array().round() * unit).matrix().eval(); };
  for (int trial = 0; trial < 50; ++trial) {
    const Vec6 x = on_lattice(random_place(0.5, random)), y = on_lattice(randomly_moved(x, random));
    const Vec2 far(5e5, 4e6);
    EXPECT_EQ(measure.value(translated(far, x)), measure.value(x));
    EXPECT_EQ(measure.gradient(translated(far, x)), measure.gradient(x));
    EXPECT_LE(
        (measure.mean_gradient(translated(far, x), translated(far, y)) - measure.mean_gradient(x, y)).norm(),
        1e-15);
  }
}

TEST_P(EdgeMotion, RotationsOfAllKeepTheValueAndTurnTheGradients) {
  for (int trial = 0; trial < 100; ++trial) {
    const Vec6 x = random_place(0.5, random), y = randomly_moved(x, random);
    const double angle = support::uniform(-3, 3, random);
    const Vec6 turned_x = rotated(angle, x), turned_y = rotated(angle, y);
    EXPECT_NEAR(measure.value(turned_x), measure.value(x), 1e-14);
    EXPECT_LE((measure.gradient(turned_x) - rotated(angle, measure.gradient(x))).norm(), 1e-14);
    EXPECT_LE(
        (measure.mean_gradient(turned_x, turned_y) - rotated(angle, measure.mean_gradient(x, y))).norm(),
        1e-13);
  }
}

TEST_P(EdgeMotion, GradientsAreTheDerivatives) {
  const double h = 1e-100;
  for (int trial = 0; trial < 100; ++trial) {
    const Vec6 x = random_place(1, random), gradient = measure.gradient(x);
    for (int c = 0; c < 6; ++c) {
      Eigen::Matrix<std::complex<double>, 6, 1> z = x.cast<std::complex<double>>();
      z[c] += std::complex<double>(0, h);
      EXPECT_NEAR(gradient[c], measure.defined(z).imag() / h, 3e-15);
    }
  }
}

TEST_P(EdgeMotion, GradientsHaveNoNetForceAndNoMoment) {
  for (int trial = 0; trial < 100; ++trial) {
    const Vec6 x = random_place(1, random), gradient = measure.gradient(x);
    EXPECT_LE(gradient.reshaped(2, 3).rowwise().sum().norm(), 1e-15);
    EXPECT_NEAR(moment(x, gradient), 0, 1e-14);
  }
}

/// The work of a constant force is the change of its potential, over steps of any size.
TEST_P(EdgeMotion, MeanGradientTimesTheMotionIsTheChangeOfTheValue) {
  for (int trial = 0; trial < 300; ++trial) {
    const Vec6 x = random_place(0.5, random), y = randomly_moved(x, random);
    const Vec6 mean = measure.mean_gradient(x, y);
    const double size = mean.norm() * (y - x).norm() + mean.norm();
    EXPECT_NEAR(mean.dot(y - x), measure.value(y) - measure.value(x), 1e-14 * size);
  }
}

TEST_P(EdgeMotion, MeanGradientHasNoNetForceAndNoMomentAboutTheMidConfiguration) {
  for (int trial = 0; trial < 300; ++trial) {
    const Vec6 x = random_place(0.5, random), y = randomly_moved(x, random);
    const Vec6 mean = measure.mean_gradient(x, y);
    EXPECT_LE(mean.reshaped(2, 3).rowwise().sum().norm(), 1e-15 * mean.norm());
    EXPECT_NEAR(moment((x + y) / 2, mean), 0, 1e-14 * mean.norm() * ((x + y) / 2).norm());
  }
}

TEST_P(EdgeMotion, MeanGradientIsTheSameBackwards) {
  for (int trial = 0; trial < 50; ++trial) {
    const Vec6 x = random_place(0.5, random), y = randomly_moved(x, random);
    EXPECT_LE((measure.mean_gradient(x, y) - measure.mean_gradient(y, x)).norm(), 1e-14);
  }
}

TEST_P(EdgeMotion, MeanGradientIsTheGradientWhereNothingMovesAndSecondOrderNearTheMiddle) {
  for (int trial = 0; trial < 50; ++trial) {
    const Vec6 x = random_place(0.5, random), motion = Vec6::Random();
    EXPECT_LE((measure.mean_gradient(x, x) - measure.gradient(x)).norm(), 1e-14);
    const auto error = [&](double h) {
      return (measure.mean_gradient(x - h * motion, x + h * motion) - measure.gradient(x)).norm();
    };
    const double ratio = error(1e-3) / error(5e-4);
    EXPECT_NEAR(ratio, 4, 0.05);
  }
}

TEST_P(EdgeMotion, OfARotationTheMeanGradientIsThatOfTheMiddleTimesTheCosineOfHalfTheAngle) {
  for (const double angle : {-2.0, -0.1, 0.5, 3.0}) {
    const Vec6 x = random_place(0.5, random);
    const Vec6 expected = std::cos(angle / 2) * rotated(angle / 2, measure.gradient(x));
    EXPECT_LE((measure.mean_gradient(x, rotated(angle, x)) - expected).norm(), 1e-14);
  }
}

/// What the paper's forms leave out vanishes with the gap: the edge's stretch in (36), its turning in (44).
TEST_P(EdgeMotion, GradientsAreThoseOfThePaperAndATermProportionalToTheGap) {
  for (int trial = 0; trial < 100; ++trial) {
    const Vec6 x = random_place(trial % 2 ? 0.5 : 0, random);
    const auto [i, j, k] = place_at(x);
    const VertexEdgeForm form = measure.first_order({i, j, k});
    const Vec6 paper = components(form.gradient);

    const double l = (k - j).norm(), g = gap({i, j, k});
    const Vec2 t = (k - j) / l, n(t.y(), -t.x());
    const Vec2 by_k = g / l * (measure.is_gap ? Vec2(-t) : n);
    const Vec6 left_out = (Vec6() << Vec2::Zero(), -by_k, by_k).finished();
    EXPECT_NEAR(form.constant, measure.value(x), 1e-14);
    EXPECT_LE((measure.gradient(x) - paper - left_out).norm(), 1e-14);
  }
}

/// Coefficients (37), with the sign of a gap that is negative inside, and (45) for a lock point within the
/// edge.
TEST(EdgeMotion, FormsHaveTheCoefficientsOfThePaper) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const VertexEdgePositions at = place_at(random_place(0.5, random));
    const auto& [i, j, k] = at;
    const double l = (k - j).norm(), lock = support::uniform(0, 1, random);
    const Vec2 o = (1 - lock) * j + lock * k;
    Vec6 e, e_bar;
    e << j.y() - k.y(), k.x() - j.x(), k.y() - i.y(), i.x() - k.x(), i.y() - j.y(), j.x() - i.x();
    e_bar << (k - j) / l, (j - k) / (l * l) * (o - k).norm(), (j - k) / (l * l) * (o - j).norm();
    EXPECT_LE((components(gap_form(at).gradient) + e / l).norm(), 1e-14);
    EXPECT_LE((components(slip_form(at, lock).gradient) - e_bar).norm(), 1e-14);
    EXPECT_NEAR(slip_form(at, edge_fraction(i, j, k)).constant, 0, 1e-14);
  }
}

/// A point with unknowns of its own, and the same told by terms: the same form.
TEST_P(EdgeMotion, FormsOfPointsWithUnknownsOfTheirOwnAreThoseOfAnyPoints) {
  const std::vector<PointMap::Term> axes{{0, Vec2::UnitX()}, {1, Vec2::UnitY()}};
  for (const auto& [a, b, c] : {std::array{6, 0, 2}, {6, 2, 0}, {6, 0, 0}}) {
    const Vec6 x = random_place(0.5, random);
    const VectorXd d = 0.05 * VectorXd::Random(8);
    const VertexEdgeGradient by = gradient_at(measure.gradient(x));
    const MovingVertexEdge of_own{{place_at(x)}, PointMap(a), PointMap(b), PointMap(c), {}},
        of_any{{place_at(x)}, {a, axes}, {b, axes}, {c, axes}, {}};
    const AffineForm own = of_own.linear_form(1, by, d), any = of_any.linear_form(1, by, d);
    EXPECT_EQ(own.constant, any.constant);
    ASSERT_TRUE(std::ranges::equal(own.unknowns(), any.unknowns()));
    EXPECT_TRUE(std::ranges::equal(own.coefficients(), any.coefficients()));
    EXPECT_EQ(of_own.change_along(by, d), any.change(d));
  }
}

TEST_P(EdgeMotion, LinearFormHasTheValueAtItsUnknownsAndTheDerivativesByThem) {
  for (int trial = 0; trial < 20; ++trial) {
    const Vec6 x0 = random_place(0.5, random);
    const auto of_i = random_terms(random), of_j = random_terms(random), of_k = random_terms(random);
    const PointMap i(6, of_i), j(0, of_j), k(0, of_k);
    const auto value = [&](const VectorXd& d) { return measure.value(x0 + coordinates({i(d), j(d), k(d)})); };
    const VectorXd d = 0.05 * VectorXd::Random(12), change = VectorXd::Random(12);
    const VertexEdgeGradient by = gradient_at(measure.gradient(x0 + coordinates({i(d), j(d), k(d)})));
    const AffineForm form = MovingVertexEdge{{place_at(x0)}, i, j, k, {}}.linear_form(value(d), by, d);

    const double h = 1e-6;
    EXPECT_NEAR(form(d), value(d), 1e-15);
    EXPECT_EQ(form.unknowns().size(), 12u);
    EXPECT_NEAR(form.change(change), (value(d + h * change) - value(d - h * change)) / (2 * h), 1e-8);
  }
}

/// The forms know blocks only by their point maps: here a rigid one that can but translate, against a fixed
/// edge and as the edge's own block.
TEST(EdgeMotion, ABlockOfTwoUnknownsFits) {
  const std::vector<PointMap::Term> terms{{7, Vec2::UnitX()}, {3, Vec2::UnitY()}};
  const PointMap translating(0, terms);
  const VertexEdgePositions positions{{0.25, -0.5}, {0, 0}, {1, 0}};
  const MovingVertexEdge vertex{{positions}, translating, {}, {}, {}},
      edge{{positions}, {}, translating, translating, {}};
  const AffineForm on_fixed = vertex.form(gap_form(positions)), on_moving = edge.form(gap_form(positions)),
                   slip = edge.form(slip_form(positions, 0.75));
  VectorXd d = VectorXd::Zero(8);
  d[7] = 0.125;
  d[3] = 2;
  EXPECT_DOUBLE_EQ(on_fixed.change(d), -2);
  EXPECT_DOUBLE_EQ(on_moving.change(d), 2);
  EXPECT_EQ(on_moving.unknowns().size(), 2u);
  EXPECT_DOUBLE_EQ(slip(d), 0.25 - 0.75 - 0.125);
}
