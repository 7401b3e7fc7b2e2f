#include <ddacontact/detection/separation.hpp>
#include <tests/ddacontact/detection/polygon_pair.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <set>

using namespace ddacontact;
using namespace support;

namespace {

/// Two random polygons at the given separation: b is pushed along a random line past a, till it is there.
PolygonPair random_pair(double separation, std::mt19937& random) {
  PolygonPair pair{support::random_convex_polygon(3 + static_cast<int>(random() % 5), random),
                   support::random_convex_polygon(3 + static_cast<int>(random() % 5), random)};
  const Vec2 line = support::random_direction(random);
  const Vec2 aside = uniform(-0.5, 0.5, random) * Vec2(-line.y(), line.x());
  double near = 0, far = 4;
  const Points b = pair.b;
  for (int k = 0; k < 60; ++k) {
    const double middle = (near + far) / 2;
    pair.b = b.colwise() + (aside + middle * line);
    (ddacontact::separation(pair.a, pair.b) < separation ? near : far) = middle;
  }
  const bool missed = std::abs(ddacontact::separation(pair.a, pair.b) - separation) > 1e-12;
  return missed ? random_pair(separation, random) : pair;
}

}  // namespace

TEST(NarrowPhase, TwoTouchingEdgesMeetInTheTwoEndsOfTheirOverlap) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const double w = std::pow(10, uniform(-1, 1, random)), v = std::pow(10, uniform(-1, 1, random));
    const double search_margin = 0.1 * std::min({w, v, 1.});
    // Overlaps from a little longer than the reach; ends apart by anything from much less than the reach.
    double shift = uniform(-v + 1.5 * search_margin, w - 1.5 * search_margin, random);
    if (trial % 3 == 0) shift = (trial % 2 ? 1 : -1) * search_margin * std::pow(10, uniform(-4, 0, random));
    PolygonPair pair{box(0, -1, w, 1), box(shift, 0, v, 1)};
    if (trial % 2) pair = pair.mirrored();
    const double angle = uniform(0, 7, random);
    const Vec2 by(uniform(-9, 9, random), uniform(-9, 9, random));
    pair = pair.renumbered(static_cast<int>(random() % 4), static_cast<int>(random() % 4)).moved(angle, by);

    const double sign = trial % 2 ? -1 : 1;
    const Mat2 R = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Vec2 low = R * Vec2(sign * std::max(0., shift), 0) + by,
               high = R * Vec2(sign * std::min(w, shift + v), 0) + by;
    for (bool swapped : {false, true}) {
      const auto found = pair.contact_set(search_margin, {}, swapped);
      ASSERT_EQ(found.size(), 2u) << "trial " << trial << ", widths " << w << ", " << v << ", shift "
                                  << shift;
      int at_low = 0, at_high = 0;
      for (const VertexEdge& c : found) {
        EXPECT_NEAR(pair.gap(c), 0, 1e-12);
        EXPECT_GE(pair.inset(c), -1e-12);
        at_low += (pair.vertex(c) - low).norm() < 1e-11;
        at_high += (pair.vertex(c) - high).norm() < 1e-11;
      }
      EXPECT_EQ(at_low, 1);
      EXPECT_EQ(at_high, 1);
    }
  }
}

TEST(NarrowPhase, CoincidentCornersGiveOneContactAnEnd) {
  std::mt19937 random(2);
  for (int trial = 0; trial < 500; ++trial) {
    const double noise = trial % 2 ? 0.3 * coincidence : 0;
    const double dx = uniform(-noise, noise, random), dy = uniform(-noise, noise, random);
    PolygonPair pair{box(0, -1, 2, 1), box(dx, dy, 2, 1)};
    pair = pair.renumbered(static_cast<int>(random() % 4), static_cast<int>(random() % 4))
               .moved(uniform(0, 7, random), Vec2::Zero());
    const auto found = pair.contacts(0.1);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_NEAR((pair.vertex(found[0]) - pair.vertex(found[1])).norm(), 2, 1e-5);
    EXPECT_EQ(pair.contact_set(0.1, {}, true).size(), 2u);
  }
}

TEST(NarrowPhase, AVertexOnAnEdgeIsOneContact) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    Points wedge(2, 3);
    const double x = uniform(0.2, 1.8, random), tilt = uniform(-0.5, 0.5, random);
    wedge << 0, 0.5, -0.5,  //
        0, 1, 1;
    wedge = (Eigen::Rotation2Dd(tilt).toRotationMatrix() * wedge).colwise() +
            Vec2(x, uniform(-0.01, 0.05, random));
    PolygonPair pair{box(0, -1, 2, 1), wedge};
    pair = pair.moved(uniform(0, 7, random), Vec2::Zero());
    EXPECT_EQ(pair.contact_set(0.1), (std::set<VertexEdge>{{1, 0, 0, 2}}));
    EXPECT_EQ(pair.contact_set(0.1, {}, true), (std::set<VertexEdge>{{1, 0, 0, 2}}));
  }
}

/// A corner pressed upon a corner enters through the shallower side: as one contact, or as the two ends of
/// the overlap of two parallel sides.
TEST(NarrowPhase, CornerOnCornerMeetsThroughTheShallowerSide) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    const double dx = uniform(-0.02, 0.02, random), dy = uniform(-0.02, 0.02, random);
    PolygonPair pair{box(-1, -1, 1, 1), box(0, 0, 1, 1).colwise() + Vec2(dx, dy)};
    pair = pair.moved(uniform(0, 7, random), Vec2::Zero());
    const auto found = pair.contacts(0.05);
    EXPECT_FALSE(found.empty());
    for (const VertexEdge& c : found) EXPECT_NEAR(pair.gap(c), std::max(dx, dy), 1e-12) << dx << " " << dy;
  }
}

TEST(NarrowPhase, PairsBeyondReachDoNotMeet) {
  std::mt19937 random(5);
  for (int trial = 0; trial < 1000; ++trial) {
    const double search_margin = uniform(0.01, 0.5, random);
    const PolygonPair pair = random_pair(search_margin * uniform(1.001, 3, random), random);
    EXPECT_TRUE(pair.contacts(search_margin).empty());
  }
}

/// Every vertex that lies on an edge of the other polygon, well within it, and belongs to two touching
/// polygons.
TEST(NarrowPhase, EveryTouchingVertexIsFound) {
  std::mt19937 random(7);
  int n_touching = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const PolygonPair pair = random_pair(0, random);
    const double search_margin = std::pow(10, uniform(-2, -0.5, random));
    const auto found = pair.contact_set(search_margin);
    for (int block : {0, 1})
      for (int v = 0; v < pair.of(block).cols(); ++v)
        for (int e = 0; e < pair.of(1 - block).cols(); ++e) {
          const VertexEdge c{block, v, 1 - block, e};
          if (std::abs(pair.gap(c)) > 1e-9 || pair.inset(c) < 10 * coincidence) continue;
          ++n_touching;
          EXPECT_TRUE(found.contains(c)) << "trial " << trial;
        }
    EXPECT_EQ(found, pair.contact_set(search_margin, {}, true)) << "trial " << trial;
  }
  EXPECT_GT(n_touching, 2500);
}

/// A resting contact stays where it was while corners jitter about each other by less than the coincidence.
TEST(NarrowPhase, ClosedContactsAreKeptUnderPerturbationsBelowCoincidence) {
  std::mt19937 random(10);
  for (int trial = 0; trial < 300; ++trial) {
    PolygonPair pair{box(0, -1, 2, 1), box(uniform(-0.4, 0.4, random) * coincidence, 0, 2, 1)};
    pair = pair.moved(uniform(0, 7, random), Vec2::Zero());
    const auto kept = pair.contacts(0.1);
    ASSERT_EQ(kept.size(), 2u);
    for (int jitter = 0; jitter < 10; ++jitter) {
      const Vec2 by = 0.4 * coincidence * support::random_direction(random);
      const PolygonPair perturbed{pair.a, pair.b.colwise() + by};
      EXPECT_EQ(perturbed.contact_set(0.1, kept), std::set<VertexEdge>(kept.begin(), kept.end()));
    }
  }
}

/// Plates much thinner than the reach, and a block much smaller than it: only facing edges meet.
TEST(NarrowPhase, NothingMeetsThroughTheThicknessOfAPlate) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 500; ++trial) {
    const double h = std::pow(10, uniform(-2, -0.7, random)), w = uniform(0.3, 3, random);
    const double search_margin = uniform(0.5, 2, random) * h;
    const double x = uniform(search_margin, 3, random);
    const bool tiny = trial % 2;
    const PolygonPair pair =
        PolygonPair{box(0, -h, 8, h), box(x, 0, tiny ? h / 2 : w, tiny ? h / 2 : h)}.moved(
            uniform(0, 7, random), Vec2(1, 2));
    const auto found = pair.contact_set(search_margin);
    EXPECT_EQ(found, (std::set<VertexEdge>{{1, 0, 0, 2}, {1, 1, 0, 2}}))
        << "thickness " << h << ", reach " << search_margin;
  }
}

/// Flush faces of two squares that only lie at each other, shifted by what round-off may leave: each corner
/// is met from the side that it was met from before, open or not; else from that where it lies over the
/// other.
TEST(NarrowPhase, AnOpenContactStaysWhereTwoCornersLieAtOnePlace) {
  const PolygonPair squares{box(0, 0, 1, 1), box(1, 1e-9, 1, 1)};
  const VertexEdge over{1, 0, 0, 1}, beside{0, 1, 1, 3};
  const auto lower_corner = [&](const std::vector<EarlierContact>& earlier) {
    const PairLimits limits{0.01, 0.5, coincidence, lip};
    const std::vector<VertexEdge> found =
        contacts_between(Outline(0, squares.a), Outline(1, squares.b), limits, earlier);
    EXPECT_EQ(found.size(), 2u) << "one a corner";
    return std::ranges::find(found, over) != found.end() ? over : beside;
  };
  EXPECT_EQ(lower_corner({}), over);
  EXPECT_EQ(lower_corner({{over, 0, false}}), over);
  EXPECT_EQ(lower_corner({{beside, 0, false}}), beside);
}

/// A square diagonally above another, corner on corner, that moves down and to the left, more steeply than
/// not: it passes the side last, unless a third one covers that. Then it meets the top; with what covers the
/// side level with the top too, and not where that rises.
TEST(NarrowPhase, WhatAThirdPolygonCoversIsNoEntrance) {
  const Points lower = box(0, 0, 1, 1), upper = box(1, 1, 1, 1);
  const VertexEdge side{1, 0, 0, 1}, face{0, 2, 1, 3}, top{1, 0, 0, 2}, bottom{0, 2, 1, 0};
  const auto met = [&](const std::vector<ddacontact::CoveredPart>& covered) {
    const Points moved = upper.colwise() + Vec2(-1e-3, -2e-3);
    const std::vector<VertexEdge> found =
        contacts_between({0, lower}, {1, upper, moved}, {0.01, 0.5, coincidence, lip}, {}, covered);
    EXPECT_EQ(found.size(), 1u);
    return found.front();
  };
  const VertexEdge free = met({});
  EXPECT_TRUE(free == side || free == face);
  const VertexEdge level = met({{0, 1, 0, 1, {-1, 0}, {1, 0}}});
  EXPECT_TRUE(level == top || level == bottom);
  EXPECT_EQ(met({{0, 1, 0, 1, {-1, 0}, {1, 1}}}), top);
  EXPECT_EQ(met({{0, 1, 0, 0.5, {-1, 0}, {0, 1}}}), free) << "not up to the corner";
  EXPECT_EQ(met({{0, 1, 0, 1, {-1, 0}, {1, 1}}, {0, 2, 0, 1, {1, 1}, {0, -1}}}).vertex_block, 1)
      << "the lower corner is within what covers both of its sides";
}
