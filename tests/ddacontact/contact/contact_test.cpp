/// \file What a contact says of its vertex and edge, sharp and rounded, and of its bond and dashpot.
#include <ddacontact/contact/contact.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>

using namespace ddacontact;
using support::uniform;

namespace {

/// Vertex i, edge jk and the vertex after i, whose displacements are the unknowns 0 .. 7. The edge has a
/// length of about 1, the vertex is near it.
class RandomContacts : public testing::TestWithParam<bool> {
 protected:
  std::mt19937 random{5};

  Vec2 any(double size) { return {uniform(-size, size, random), uniform(-size, size, random)}; }
  VectorXd any_displacements(double size) {
    VectorXd d(8);
    for (double& u : d) u = uniform(-size, size, random);
    return d;
  }
  /// Rounded, or sharp.
  Contact any_contact() {
    Contact contact;
    contact.motion = {
        {Vec2(0.3, -0.4) + any(0.2), any(0.1), Vec2(1, 0) + any(0.1)}, PointMap(0), PointMap(2), PointMap(4)};
    contact.history.lock = uniform(0, 1, random);
    contact.size = 1;
    if (GetParam())
      contact.motion.rounding = std::make_shared<MovingRounding>(
          MovingRounding{{.centre = {0.1, 0.1}, .surface = {0.02, 0.05}, .radius = 0.1},
                         Vec2(1.2, -1) + any(0.2),
                         PointMap(6)});
    return contact;
  }
  /// Of all four points, about the origin, then a shift.
  static VectorXd rigid_motion(const MovingVertexEdge& motion, double angle, const Vec2& shift) {
    const Mat2 R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const RoundedPositions at = motion.start_of_all();
    VectorXd d(8);
    int first = 0;
    for (const Vec2& x : {at.i, at.j, at.k, at.after_i}) {
      d.segment<2>(first) = R * x - x + shift;
      first += 2;
    }
    return d;
  }
};

constexpr double h = 1e-6;

}  // namespace

TEST_P(RandomContacts, GapAndSlipStayWhenBothBlocksMoveAsOne) {
  for (int trial = 0; trial < 50; ++trial) {
    const Contact contact = any_contact();
    const double lock = contact.history.lock;
    const VectorXd d = rigid_motion(contact.motion, uniform(-3, 3, random), any(5));
    const GapAndSlip before = contact.motion.rates_at_start(lock),
                     after = contact.motion.gap_and_slip_at(d, lock, Directions::of_end);
    EXPECT_NEAR(after.gap, contact.motion.start_gap(), 1e-13);
    EXPECT_NEAR(after.slip, before.slip, 1e-13);
    EXPECT_NEAR(before.slip, contact.motion.rates_at_start(0).slip - lock * contact.edge_length(), 1e-14)
        << "from the lock point on";
  }
}

/// Forms, and changes along gradients, against differences of the exact gap and slip.
TEST_P(RandomContacts, FormsOfGradientsAreDerivatives) {
  for (int trial = 0; trial < 50; ++trial) {
    const Contact contact = any_contact();
    const double lock = contact.history.lock;
    const VectorXd d = any_displacements(0.1), way = any_displacements(1);
    const auto at = [&](double t) {
      return contact.motion.gap_and_slip_at(d + t * way, lock, Directions::of_end);
    };
    const GapAndSlip here = at(0);
    const double of_gap = (at(h).gap - at(-h).gap) / (2 * h), of_slip = (at(h).slip - at(-h).slip) / (2 * h);
    EXPECT_NEAR(contact.motion.form(here.by_gap).change(way), of_gap, 1e-8);
    EXPECT_NEAR(contact.motion.change_along(here.by_gap, way), of_gap, 1e-8);
    EXPECT_NEAR(contact.motion.form(here.by_slip).change(way), of_slip, 1e-8);
    const AffineForm linear = contact.motion.linear_form(here.slip, here.by_slip, d);
    EXPECT_NEAR(linear(d), here.slip, 1e-14);
    EXPECT_NEAR(linear(d + way) - linear(d), of_slip, 1e-8);
  }
}

/// Of a vertex that touches, those of first order are the exact ones and their derivatives; the constants are
/// at any distance.
TEST_P(RandomContacts, FormsOfFirstOrderAreThoseOfTheStart) {
  for (int trial = 0; trial < 50; ++trial) {
    Contact contact = any_contact();
    EXPECT_NEAR(contact.first_gap().constant, contact.motion.start_gap(), 1e-14);
    MovingVertexEdge& motion = contact.motion;
    if (!motion.rounding) motion.start.i -= motion.start_gap() * motion.start.outwards();
    if (!motion.rounding)
      contact.history.lock = edge_fraction(motion.start.i, motion.start.j, motion.start.k);
    const auto at = [&](const VectorXd& d) {
      return motion.gap_and_slip_at(d, contact.history.lock, Directions::of_end);
    };
    const VectorXd way = any_displacements(1);
    EXPECT_NEAR(contact.first_slip().constant, at(VectorXd::Zero(8)).slip, 1e-14);
    EXPECT_NEAR(motion.form(contact.first_gap()).change(way), (at(h * way).gap - at(-h * way).gap) / (2 * h),
                1e-8);
    EXPECT_NEAR(motion.form(contact.first_slip()).change(way),
                (at(h * way).slip - at(-h * way).slip) / (2 * h), 1e-8);
  }
}

INSTANTIATE_TEST_SUITE_P(SharpAndRounded, RandomContacts, testing::Bool());

namespace {

/// A vertex 0.1 above the middle of an edge of 2 m, or as far as `gap`.
Contact above_an_edge(double gap = 0.1) {
  Contact contact;
  contact.motion.start = {{1, -gap}, {0, 0}, {2, 0}};
  contact.history.lock = 0.5;
  contact.size = 1;
  return contact;
}

}  // namespace

TEST(Contact, VertexIsOnTheEdgeAndOnWhatContinuesIt) {
  Contact contact = above_an_edge();
  EXPECT_EQ(contact.edge_length(), 2);
  EXPECT_TRUE(contact.starts_on_edge());
  const double little = contact.end_tolerance();
  EXPECT_TRUE(contact.is_on_edge(1 + little / 2) && contact.is_on_edge(-1 - little / 2));
  EXPECT_FALSE(contact.is_on_edge(1 + 2 * little) || contact.is_on_edge(-1 - 2 * little));
  EXPECT_TRUE(contact.is_on_edge(1.1, 0.2) && contact.is_on_edge(-1.1, 0.2));
  contact.straight_before = 0.3;
  contact.straight_after = 0.5;
  EXPECT_TRUE(contact.is_on_edge(1.49) && contact.is_on_edge(-1.29));
  EXPECT_FALSE(contact.is_on_edge(1.51) || contact.is_on_edge(-1.31));
}

TEST(Contact, DashpotsResistMotionFromTheStartAndThoseOfStiffJointsFromWhereTheyClose) {
  Contact contact = above_an_edge();
  contact.damping = 50;
  EXPECT_DOUBLE_EQ(contact.dashpot_force(0.1), 0);
  EXPECT_DOUBLE_EQ(contact.dashpot_force(0.06), 2) << "it pushes what approaches";
  EXPECT_DOUBLE_EQ(contact.dashpot_force(0.14), -2);
  contact.law.compliant = true;
  contact.history.gap_offset = 0.02;
  EXPECT_DOUBLE_EQ(contact.dashpot_force(0.02), 0);
  EXPECT_DOUBLE_EQ(contact.dashpot_force(-0.02), 2);
  contact.motion.start.i.y() = 0.03;  // pressed already
  EXPECT_DOUBLE_EQ(contact.dashpot_force(-0.03), 0);
}

TEST(Contact, IsBondedByGlueOrByABondOfSomeStrength) {
  Contact contact;
  EXPECT_FALSE(contact.has_bond());
  contact.history.bonded = true;
  EXPECT_FALSE(contact.has_bond()) << "of no strength";
  contact.law.tension = 1;
  EXPECT_TRUE(contact.has_bond());
  contact.law = {.cohesion = 1};
  EXPECT_TRUE(contact.has_bond());
  contact.history.bonded = false;
  EXPECT_FALSE(contact.has_bond()) << "it is broken";
  contact.law = {.glued = true};
  EXPECT_TRUE(contact.has_bond());
}

TEST(Contact, LastsWhileItIsClosedOrHasAnOffset) {
  ContactRecord contact;
  EXPECT_FALSE(contact.closed() || contact.lasts());
  for (const ContactState state :
       {ContactState::stick, ContactState::slip_forward, ContactState::slip_backward}) {
    contact.history.state = state;
    EXPECT_TRUE(contact.closed() && contact.lasts());
  }
  contact.history.state = ContactState::open;
  contact.history.gap_offset = -1e-3;
  EXPECT_TRUE(!contact.closed() && contact.lasts());
}
