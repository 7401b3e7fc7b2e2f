#include <ddacontact/contact/contact.hpp>
#include <ddacontact/contact/kinematics.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

using namespace ddacontact;

namespace {

/// Vertex i and edge jk whose coordinates are the unknowns 0..5.
struct Trio {
  Vec2 i, j, k;

  MovingVertexEdge moving() const { return {{i, j, k}, PointMap(0), PointMap(2), PointMap(4)}; }
  AffineForm gap() const { return moving().form(gap_form({i, j, k})); }
  AffineForm slip(double lock) const { return moving().form(slip_form({i, j, k}, lock)); }
  Trio moved(const VectorXd& d) const {
    return {i + d.segment<2>(0), j + d.segment<2>(2), k + d.segment<2>(4)};
  }

  double length() const { return (k - j).norm(); }
  Vec2 tangent() const { return (k - j) / length(); }
  Vec2 outward() const { return {tangent().y(), -tangent().x()}; }
  double exact_gap() const { return outward().dot(i - j); }
  double exact_slip(double lock) const { return tangent().dot(i - (1 - lock) * j - lock * k); }
};

/// A trio with the vertex at this gap over a random place of the edge, or a little beyond its ends.
Trio random_trio(double gap, std::mt19937& random) {
  Trio trio;
  trio.j = Vec2(support::uniform(-1, 1, random), support::uniform(-1, 1, random));
  trio.k = trio.j + support::uniform(0.5, 2, random) * support::random_direction(random);
  trio.i = trio.j + support::uniform(-0.2, 1.2, random) * (trio.k - trio.j) + gap * trio.outward();
  return trio;
}

VectorXd translation(const Vec2& u) {
  VectorXd d(6);
  d << u, u, u;
  return d;
}

VectorXd rotation(const Trio& trio, const Vec2& pole) {
  VectorXd d(6);
  int first = 0;
  for (const Vec2& x : {trio.i, trio.j, trio.k}) {
    d.segment<2>(first) << -(x - pole).y(), (x - pole).x();
    first += 2;
  }
  return d;
}

template <class Function>
VectorXd gradient(const Trio& trio, const Function& f) {
  const double h = 1e-6;
  VectorXd g(6);
  for (int k = 0; k < 6; ++k)
    g[k] = (f(trio.moved(h * VectorXd::Unit(6, k))) - f(trio.moved(-h * VectorXd::Unit(6, k)))) / (2 * h);
  return g;
}

VectorXd gradient(const AffineForm& form) {
  VectorXd g = VectorXd::Zero(6);
  form.add_gradient(1, g);
  return g;
}

}  // namespace

TEST(Kinematics, ConstantsAreTheGeometricGapAndSlip) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 100; ++trial) {
    const double gap = support::uniform(-0.3, 0.3, random), lock = support::uniform(-0.1, 1.1, random);
    const Trio trio = random_trio(gap, random);
    EXPECT_NEAR(trio.gap().constant, gap, 1e-14);
    EXPECT_NEAR(trio.slip(lock).constant, trio.exact_slip(lock), 1e-14);
    const double fraction = edge_fraction(trio.i, trio.j, trio.k);
    EXPECT_NEAR(trio.slip(fraction).constant, 0, 1e-14);
  }
}

TEST(Kinematics, GapIsNegativeInsideACounterClockwiseBlock) {
  EXPECT_DOUBLE_EQ((Trio{{0.5, 0.1}, {0, 0}, {1, 0}}).gap().constant, -0.1);
  EXPECT_DOUBLE_EQ((Trio{{0.5, -0.1}, {0, 0}, {1, 0}}).gap().constant, 0.1);
}

/// Of a touching vertex the forms are the derivatives of the exact gap and slip.
TEST(Kinematics, TouchingFormsAreTheDerivativesOfTheExactGapAndSlip) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const Trio trio = random_trio(0, random);
    const double lock = edge_fraction(trio.i, trio.j, trio.k);
    EXPECT_LE((gradient(trio.gap()) - gradient(trio, [](const Trio& t) { return t.exact_gap(); })).norm(),
              1e-8);
    EXPECT_LE((gradient(trio.slip(lock)) - gradient(trio, [&](const Trio& t) { return t.exact_slip(lock); }))
                  .norm(),
              1e-8);
  }
}

/// Away from touch (36) freezes the length of the edge, and (44) its direction.
TEST(Kinematics, DistantFormsFreezeTheEdgesLengthAndDirection) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Trio trio = random_trio(support::uniform(-0.5, 0.5, random), random);
    const double lock = support::uniform(0, 1, random), l = trio.length();
    const Vec2 t = trio.tangent();
    const auto twice_area_over_l = [&](const Trio& m) { return -cross(m.j - m.i, m.k - m.i) / l; };
    const auto along_t = [&](const Trio& m) { return t.dot(m.i - (1 - lock) * m.j - lock * m.k); };
    EXPECT_LE((gradient(trio.gap()) - gradient(trio, twice_area_over_l)).norm(), 1e-8);
    EXPECT_LE((gradient(trio.slip(lock)) - gradient(trio, along_t)).norm(), 1e-8);
  }
}

TEST(Kinematics, RigidMotionsOfThePairLeaveTheGapUnchanged) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 100; ++trial) {
    const Trio trio = random_trio(support::uniform(-0.5, 0.5, random), random);
    const Vec2 any = support::random_direction(random);
    EXPECT_NEAR(trio.gap().change(translation(any)), 0, 1e-14);
    EXPECT_NEAR(trio.gap().change(rotation(trio, any)), 0, 1e-13);
  }
}

TEST(Kinematics, RigidMotionsOfATouchingPairLeaveTheSlipUnchanged) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Trio trio = random_trio(0, random);
    const double lock = support::uniform(0, 1, random);
    const Vec2 any = support::random_direction(random);
    EXPECT_NEAR(trio.slip(lock).change(translation(any)), 0, 1e-14);
    EXPECT_NEAR(trio.slip(lock).change(rotation(trio, any)), 0, 1e-13);
  }
}

/// Coefficients (37), with the sign of a gap that is negative inside, and (45) for a lock point within the
/// edge.
TEST(Kinematics, CoefficientsAreThoseOfThePaper) {
  std::mt19937 random(6);
  for (int trial = 0; trial < 50; ++trial) {
    const Trio trio = random_trio(support::uniform(-0.5, 0.5, random), random);
    const auto& [i, j, k] = trio;
    const double l = trio.length(), lock = support::uniform(0, 1, random);
    VectorXd e(6);
    e << j.y() - k.y(), k.x() - j.x(), k.y() - i.y(), i.x() - k.x(), i.y() - j.y(), j.x() - i.x();
    EXPECT_LE((gradient(trio.gap()) + e / l).norm(), 1e-14);

    const Vec2 o = (1 - lock) * j + lock * k;
    VectorXd e_bar(6);
    e_bar << (k - j) / l, (j - k) / (l * l) * (o - k).norm(), (j - k) / (l * l) * (o - j).norm();
    EXPECT_LE((gradient(trio.slip(lock)) - e_bar).norm(), 1e-14);
  }
}

/// The forms know blocks only by their point maps: here a rigid one that can but translate, against a fixed
/// edge and as the edge's own block.
TEST(Kinematics, ABlockOfTwoUnknownsFits) {
  const std::vector<PointMap::Term> terms{{7, Vec2::UnitX()}, {3, Vec2::UnitY()}};
  const PointMap translating(0, terms);
  const VertexEdgePositions positions{{0.25, -0.5}, {0, 0}, {1, 0}};
  const MovingVertexEdge vertex{positions, translating, {}, {}},
      edge{positions, {}, translating, translating};
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
