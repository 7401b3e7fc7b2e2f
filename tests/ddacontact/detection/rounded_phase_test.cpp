// Contacts of rounded polygons: the nearest of them is as far as the nearest arc is, wherever they are.
#include <ddacontact/contact/rounded_motion.hpp>
#include <ddacontact/detection/rounded_phase.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using namespace ddacontact;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Centres of the circles of these radii that touch both edges of each corner.
Points centres(const Points& polygon, const std::vector<double>& radii) {
  const Index n = polygon.cols();
  Points result(2, n);
  for (Index v = 0; v < n; ++v) {
    const Vec2 x = polygon.col(v), in = (x - polygon.col((v + n - 1) % n)).normalized(),
               out = (polygon.col((v + 1) % n) - x).normalized();
    result.col(v) = x + radii[v] * (out - in) / cross(in, out);
  }
  return result;
}

std::vector<double> all_of(double radius, const Points& polygon) {
  return std::vector<double>(static_cast<std::size_t>(polygon.cols()), radius);
}

/// The least distance of the arcs of one polygon from the other polygon, whose corners are met with these radii:
/// of a circle from an edge that it is over, between the arcs at its ends, or from one of these where both face
/// each other.
double gap_of_arcs(const Points& a, const RoundedBlock& of_a, const Points& b,
                   const std::vector<double>& met) {
  const Points at = centres(a, all_of(of_a.radius, a)), met_at = centres(b, met);
  const Index n = a.cols(), m = b.cols();
  double least = infinity;
  for (Index v = 0; v < n; ++v) {
    const Vec2 in = a.col(v) - a.col((v + n - 1) % n), out = a.col((v + 1) % n) - a.col(v), c = at.col(v);
    for (Index e = 0; e < m; ++e) {
      const Vec2 p = b.col(e), along = b.col((e + 1) % m) - p, before = p - b.col((e + m - 1) % m),
                 to = met_at.col(e) - c;
      if ((c - met_at.col(e)).dot(along) >= 0 && (c - met_at.col((e + 1) % m)).dot(along) <= 0 &&
          cross(c - p, along) > 0)
        least = std::min(least, cross(c - p, along) / along.norm());
      if (in.dot(to) > 0 && out.dot(to) < 0 && before.dot(to) < 0 && along.dot(to) > 0)
        least = std::min(least, to.norm() - met[e]);
    }
  }
  return least - of_a.radius;
}

/// Of the circle of a contact's vertex, of this radius, and the other polygon, whose corners are met with these.
double gap_of(const VertexEdge& contact, const Points& vertices, double radius, const Points& edges,
              const std::vector<double>& met) {
  const Vec2 centre = centres(vertices, all_of(radius, vertices)).col(contact.vertex),
             j = edges.col(contact.edge), k = edges.col((contact.edge + 1) % edges.cols());
  if (!contact.corner) return cross(centre - j, (k - j).normalized()) - radius;
  return (centre - centres(edges, met).col(contact.edge)).norm() - radius - met[contact.edge];
}

TEST(RoundedPhase, FindsTheNearestArcWhereverPolygonsAre) {
  std::mt19937 random(5);
  int corners = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Points a = support::random_convex_polygon(3 + trial % 5, random);
    Points b = support::random_convex_polygon(3 + trial % 7, random);
    const double angle = support::uniform(0, 2 * 3.14159, random);
    const RoundedBlock of_a = round_corners(a, 0.5 * largest_rounding(a).radius),
                       of_b = round_corners(b, 0.5 * largest_rounding(b).radius);
    const Vec2 way(std::cos(angle), std::sin(angle));
    b.colwise() += 6 * way;
    std::vector<double> met_a, met_b;  // sharp, as round as their arcs, or between
    const auto any_radius = [&](double largest) {
      return std::clamp(support::uniform(-0.5, 1.5, random), 0.0, 1.0) * largest;
    };
    for (Index v = 0; v < a.cols(); ++v) met_a.push_back(any_radius(of_a.radius));
    for (Index v = 0; v < b.cols(); ++v) met_b.push_back(any_radius(of_b.radius));
    const auto gap_now = [&] {
      return std::min(gap_of_arcs(a, of_a, b, met_b), gap_of_arcs(b, of_b, a, met_a));
    };
    for (int k = 0; k < 60 && gap_now() > 0.01; ++k) b.colwise() -= gap_now() / 2 * way;
    const double gap = gap_now();
    FoundContacts found;
    const PairLimits limits{.search_margin = 0.5, .max_depth = 0.1, .coincidence = 1e-6, .lip = 1e-4};
    find_rounded_contacts({{0, a}, of_a, of_a.radius, met_a}, {{1, b}, of_b, of_b.radius, met_b}, limits, {},
                          found);
    const std::vector<VertexEdge>& contacts = found.contacts;
    double nearest = infinity;
    for (const VertexEdge& contact : contacts) {
      nearest = std::min(nearest, contact.vertex_block == 0 ? gap_of(contact, a, of_a.radius, b, met_b)
                                                            : gap_of(contact, b, of_b.radius, a, met_a));
      corners += contact.corner;
    }
    ASSERT_NEAR(nearest, gap, 1e-9) << "trial " << trial;
  }
  EXPECT_GT(corners, 100) << "circles that meet corners";
}

TEST(RoundedPhase, FacesThatLieOnEachOtherTouchInTwoPlaces) {
  Points a(2, 4), b(2, 4);
  a << 0, 1, 1, 0, 0, 0, 1, 1;
  for (const double met_radius : {0.0, 0.02, 0.05})
    for (const double shift : {0.0, 0.3, -0.3, 1e-9, -1e-9}) {
      b = a.colwise() + Vec2(shift, 1);
      const RoundedBlock rounded = round_corners(a, 0.05);
      const std::vector<double> met(4, met_radius);
      FoundContacts found;
      find_rounded_contacts({{0, a}, rounded, 0.05, met}, {{1, b}, rounded, 0.05, met},
                            {.search_margin = 1e-3, .max_depth = 0.1, .coincidence = 1e-6, .lip = 1e-4}, {},
                            found);
      EXPECT_EQ(found.contacts.size(), 2u) << shift << ", " << met_radius;
      for (const VertexEdge& contact : found.contacts) EXPECT_FALSE(contact.corner);
    }
}

TEST(RoundedPhase, TwoArcsAreOneContact) {
  Points a(2, 4), b(2, 4);
  a << 0, 1, 1, 0, 0, 0, 1, 1;
  const RoundedBlock rounded = round_corners(a, 0.05);
  const std::vector<double> met(4, 0.05);
  const double apart = 0.9 + 0.1 / std::sqrt(2.0);  // the arcs touch at 45 degrees
  b = a.colwise() + Vec2(apart, apart);
  FoundContacts found;
  find_rounded_contacts({{0, a}, rounded, 0.05, met}, {{1, b}, rounded, 0.05, met},
                        {.search_margin = 1e-3, .max_depth = 0.1, .coincidence = 1e-6, .lip = 1e-4}, {},
                        found);
  ASSERT_EQ(found.contacts.size(), 1u);
  EXPECT_EQ(found.contacts.front(), (VertexEdge{0, 2, 1, 0, true}));
}

}  // namespace
