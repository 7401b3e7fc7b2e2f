#include <ddacontact/classic/spring_law.hpp>

#include <gtest/gtest.h>

#include <ostream>
#include <vector>

namespace ddacontact {

using enum ContactState;

void PrintTo(ContactState state, std::ostream* out) {
  *out << (state == open           ? "open"
           : state == stick        ? "stick"
           : state == slip_forward ? "forward"
                                   : "backward");
}

namespace {

constexpr double tolerance = 1e-9;

/// p = 1000, p bar = 400; N = 10 at a gap of -0.01, whose friction of 5 the spring reaches at a slip of
/// 0.0125.
const JointLaw frictional{.normal_stiffness = 1000, .tangential_stiffness = 400, .friction = 0.5};
const JointLaw frictionless{.normal_stiffness = 1000, .tangential_stiffness = 400};
const JointLaw glued{
    .normal_stiffness = 1000, .tangential_stiffness = 400, .friction = 0.5, .cohesion = 3, .tension = 20};
const JointLaw cohesive{.normal_stiffness = 1000, .tangential_stiffness = 400, .cohesion = 4};

struct Row {
  const char* what;
  ContactState from;
  const JointLaw& law;
  double gap, slip, increment;
  bool bonded;
  ContactState to;
};

const std::vector<Row> table{
    // Closing and opening: touch is not penetration, separation is not pull.
    {"stays open apart", open, frictional, 0.1, 0, 0, false, open},
    {"stays open in touch", open, frictional, 0, 1, 1, false, open},
    {"stays open within round-off", open, frictional, -0.9 * tolerance, 1, 1, false, open},
    {"closes beyond round-off", open, frictional, -1.1 * tolerance, 0, 0, false, stick},
    {"stays closed in touch", stick, frictional, 0, 0, 0, false, stick},
    {"stays closed within round-off", stick, frictional, 0.9 * tolerance, 0, 0, false, stick},
    {"opens beyond round-off", stick, frictional, 1.1 * tolerance, 0, 0, false, open},
    {"opens from sliding forward", slip_forward, frictional, 0.01, 1, 1, false, open},
    {"opens from sliding backward", slip_backward, frictional, 0.01, 1, 1, false, open},
    {"opens without friction", slip_forward, frictionless, 0.01, 0, 0, false, open},
    // The shear bound, from stick and on closing.
    {"sticks below the bound", stick, frictional, -0.01, 0.0124, 1, false, stick},
    {"slips forward above it", stick, frictional, -0.01, 0.0126, -1, false, slip_forward},
    {"slips backward above it", stick, frictional, -0.01, -0.0126, 1, false, slip_backward},
    {"sticks at the bound and round-off", stick, frictional, -0.01, 0.0125 + 0.9 * tolerance, 0, false,
     stick},
    {"slips at more than round-off", stick, frictional, -0.01, 0.0125 + 1.1 * tolerance, 0, false,
     slip_forward},
    {"a touch without pressure bears no shear", stick, frictional, 0, 1e-6, 0, false, slip_forward},
    {"closing may stick", open, frictional, -0.01, -0.0124, 0, false, stick},
    {"closing may slip forward", open, frictional, -0.01, 0.0126, 0, false, slip_forward},
    {"closing may slip backward", open, frictional, -0.01, -0.0126, 0, false, slip_backward},
    // Sliding goes on in its sense, whatever the slip from the lock point.
    {"slides on", slip_forward, frictional, -0.01, -1, 0.1, false, slip_forward},
    {"slides on backward", slip_backward, frictional, -0.01, 1, -0.1, false, slip_backward},
    {"halts without moving", slip_forward, frictional, -0.01, 0, 0, false, slip_forward},
    {"slides on within round-off", slip_forward, frictional, -0.01, 0, -0.9 * tolerance, false, slip_forward},
    {"sticks on turning back", slip_forward, frictional, -0.01, 0.0124, -1.1 * tolerance, false, stick},
    {"sticks on turning forward", slip_backward, frictional, -0.01, -0.0124, 1.1 * tolerance, false, stick},
    {"sticks before it slides the other way", slip_forward, frictional, -0.01, -1, -1, false, stick},
    // A stretched spring moves back while it slides, when its bound falls.
    {"springs back sliding", slip_forward, frictional, -0.01, 0.0126, -1, false, slip_forward},
    {"springs back sliding backward", slip_backward, frictional, -0.01, -0.0126, 1, false, slip_backward},
    // Without friction a closed contact has one state.
    {"frictionless closing", open, frictionless, -0.01, 1, -1, false, slip_forward},
    {"frictionless sliding", slip_forward, frictionless, -0.01, -1, -1, false, slip_forward},
    {"frictionless sticking is mended", stick, frictionless, -0.01, 0, 0, false, slip_forward},
    // A bond bears tension up to its strength (a gap of 0.02) and adds its cohesion to the shear bound.
    {"bond bears tension", stick, glued, 0.0199, 0, 0, true, stick},
    {"bond bears tension and round-off", stick, glued, 0.02 + 0.9 * tolerance, 0, 0, true, stick},
    {"bond breaks in tension", stick, glued, 0.02 + 1.1 * tolerance, 0, 0, true, open},
    {"no bond, no tension", stick, glued, 0.001, 0, 0, false, open},
    {"an open bond does not pull back", open, glued, 0.001, 0, 0, true, open},
    {"cohesion under tension", stick, glued, 0.01, 0.0074, 0, true, stick},
    {"tension does not widen the shear bound", stick, glued, 0.01, 0.0076, 0, true, slip_forward},
    {"cohesion and friction", stick, glued, -0.01, 0.0199, 0, true, stick},
    {"beyond cohesion and friction", stick, glued, -0.01, -0.0201, 0, true, slip_backward},
    {"no bond, no cohesion", stick, glued, -0.01, 0.0126, 0, false, slip_forward},
    {"cohesion alone", stick, cohesive, -0.01, 0.0099, 0, true, stick},
    {"beyond cohesion alone", stick, cohesive, -0.01, -0.0101, 0, true, slip_backward},
};

}  // namespace

TEST(SpringLaw, NextStateFollowsTheTable) {
  for (const Row& row : table) {
    const Trial trial{.gap = row.gap,
                      .slip = row.slip,
                      .slip_increment = row.increment,
                      .tolerance = tolerance,
                      .bonded = row.bonded};
    EXPECT_EQ(next_state(row.from, row.law, trial), row.to) << row.what;
  }
}

/// Rough joints: steep at small normal forces, flat at large ones.
TEST(SpringLaw, AFrictionLawOfOnesOwnTakesThePlaceOfCoulombs) {
  const FrictionLaw rough = [](double N) { return N < 10 ? N : 10 + 0.25 * (N - 10); };
  JointLaw law = glued;
  law.friction_law = &rough;
  EXPECT_FALSE(law.frictionless());
  EXPECT_EQ(shear_bound(law, 8, false), 8);
  EXPECT_EQ(shear_bound(law, 30, true), 15 + 3);
  EXPECT_EQ(shear_bound(law, -5, false), 0);
  Trial trial{.gap = -0.03, .slip = 0.0374};  // N = 30: the spring reaches 15 at 0.0375
  EXPECT_EQ(next_state(stick, law, trial), stick);
  trial.slip = 0.0376;
  EXPECT_EQ(next_state(stick, law, trial), slip_forward);
}

/// Looking at a joint from behind turns the senses of slip around and changes nothing else.
TEST(SpringLaw, SensesOfSlipAreMirrorImages) {
  const auto mirrored = [](ContactState s) {
    return s == slip_forward ? slip_backward : s == slip_backward ? slip_forward : s;
  };
  int changes = 0;
  for (const JointLaw& law : {frictional, glued, cohesive})
    for (ContactState from : {open, stick, slip_forward, slip_backward})
      for (double gap : {-0.02, -0.01, 0., 0.01, 0.03})
        for (double slip : {-0.03, -0.015, -0.005, 0.005, 0.015, 0.03})
          for (double increment : {-0.1, 0.1})
            for (bool bonded : {false, true}) {
              const Trial trial{.gap = gap,
                                .slip = slip,
                                .slip_increment = increment,
                                .tolerance = tolerance,
                                .bonded = bonded};
              Trial from_behind = trial;
              from_behind.slip = -slip;
              from_behind.slip_increment = -increment;
              const ContactState to = next_state(from, law, trial);
              changes += to != from;
              EXPECT_EQ(next_state(mirrored(from), law, from_behind), mirrored(to));
            }
  EXPECT_GT(changes, 100);
}

/// A vertex beyond the ends of its edge is not behind it; one that has come in stays until it comes out.
TEST(SpringLaw, ClosesOnlyOnTheEdge) {
  const Trial beyond{.gap = -0.01, .tolerance = tolerance, .on_edge = false};
  EXPECT_EQ(next_state(open, frictional, beyond), open);
  EXPECT_EQ(next_state(stick, frictional, beyond), stick);
}

TEST(SpringLaw, ForcesAreInsideTheCone) {
  EXPECT_DOUBLE_EQ(normal_force(frictional, -0.01), 10);
  EXPECT_DOUBLE_EQ(normal_force(frictional, 0.01), -10);
  EXPECT_DOUBLE_EQ(shear_bound(glued, 10, true), 8);
  EXPECT_DOUBLE_EQ(shear_bound(glued, 10, false), 5);
  EXPECT_DOUBLE_EQ(shear_bound(glued, -10, true), 3);
  EXPECT_DOUBLE_EQ(shear_bound(glued, -10, false), 0);
  EXPECT_DOUBLE_EQ(shear_bound(frictionless, 10, true), 0);
}

}  // namespace ddacontact
