// Contacts of rounded polygons: the nearest of them is as far as the nearest arc is, wherever they are.
#include <ddacontact/contact/rounded_motion.hpp>
#include <ddacontact/detection/rounded_phase.hpp>
#include <tests/support/random_polygon.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

using namespace ddacontact;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Points centres(const Points& polygon, const RoundedBlock& rounded) {
  Points result(2, polygon.cols());
  for (int v = 0; v < polygon.cols(); ++v)
    result.col(v) = rounded.corners[v].centre.at(polygon.col(v), polygon.col((v + 1) % polygon.cols()));
  return result;
}

/// The least distance of the arcs of one polygon from the other polygon, less their radius: of a circle from
/// an edge that it is over, or from a corner that its arc faces.
double gap_of_arcs(const Points& a, const RoundedBlock& of_a, const Points& b) {
  const Points at = centres(a, of_a);
  const Index n = a.cols(), m = b.cols();
  double least = infinity;
  for (Index v = 0; v < n; ++v) {
    const Vec2 in = a.col(v) - a.col((v + n - 1) % n), out = a.col((v + 1) % n) - a.col(v), c = at.col(v);
    for (Index e = 0; e < m; ++e) {
      const Vec2 p = b.col(e), along = b.col((e + 1) % m) - p, to = p - c;
      const double s = -to.dot(along) / along.squaredNorm();
      if (s >= 0 && s <= 1 && cross(c - p, along) > 0)
        least = std::min(least, cross(c - p, along) / along.norm());
      if (in.dot(to) > 0 && out.dot(to) < 0) least = std::min(least, to.norm());
    }
  }
  return least - of_a.radius;
}

double gap_of(const VertexEdge& contact, const Points& a, const RoundedBlock& of_a, const Points& b,
              const RoundedBlock& of_b) {
  const bool from_a = contact.vertex_block == 0;
  const Points &vertices = from_a ? a : b, &edges = from_a ? b : a;
  const RoundedBlock& of_vertex = from_a ? of_a : of_b;
  const Vec2 centre = centres(vertices, of_vertex).col(contact.vertex), j = edges.col(contact.edge),
             k = edges.col((contact.edge + 1) % edges.cols());
  return (contact.corner ? (centre - j).norm() : cross(centre - j, (k - j).normalized())) - of_vertex.radius;
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
    const auto gap_now = [&] { return std::min(gap_of_arcs(a, of_a, b), gap_of_arcs(b, of_b, a)); };
    for (int k = 0; k < 60 && gap_now() > 0.01; ++k) b.colwise() -= gap_now() / 2 * way;
    const double gap = gap_now();
    FoundContacts found;
    const PairLimits limits{.search_margin = 0.5, .max_depth = 0.1, .coincidence = 1e-6, .lip = 1e-4};
    find_rounded_contacts({{0, a}, of_a}, {{1, b}, of_b}, limits, {}, found);
    const std::vector<VertexEdge>& contacts = found.contacts;
    double nearest = infinity;
    for (const VertexEdge& contact : contacts) {
      nearest = std::min(nearest, gap_of(contact, a, of_a, b, of_b));
      corners += contact.corner;
    }
    ASSERT_NEAR(nearest, gap, 1e-9) << "trial " << trial;
  }
  EXPECT_GT(corners, 100) << "circles that meet corners";
}

TEST(RoundedPhase, FacesThatLieOnEachOtherTouchInTwoPlaces) {
  Points a(2, 4), b(2, 4);
  a << 0, 1, 1, 0, 0, 0, 1, 1;
  for (const double shift : {0.0, 0.3, -0.3, 1e-9}) {
    b = a.colwise() + Vec2(shift, 1);
    const RoundedBlock rounded = round_corners(a, 0.05);
    FoundContacts found;
    find_rounded_contacts({{0, a}, rounded}, {{1, b}, rounded},
                          {.search_margin = 1e-3, .max_depth = 0.1, .coincidence = 1e-6, .lip = 1e-4}, {},
                          found);
    EXPECT_EQ(found.contacts.size(), 2u) << shift;
    for (const VertexEdge& contact : found.contacts) EXPECT_FALSE(contact.corner);
  }
}

}  // namespace
