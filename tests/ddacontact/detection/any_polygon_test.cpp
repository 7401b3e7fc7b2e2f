// Contacts of concave polygons with vertices on straight edges, against what moving polygons meet first.
#include <ddacontact/detection/contact_length.hpp>
#include <ddacontact/detection/corner.hpp>
#include <ddacontact/detection/separation.hpp>
#include <tests/ddacontact/detection/polygon_pair.hpp>
#include <tests/support/random_shapes.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <optional>

using namespace ddacontact;
using namespace support;

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// Two polygons of sizes up to 1:30 that are `gap` from touching along a random line.
PolygonPair nearly_touching_pair(double gap, std::mt19937& random) {
  while (true) {
    PolygonPair pair{random_shape(random), random_shape(random)};
    const double size = std::pow(30, -uniform(0, 1, random));
    (random() % 2 ? pair.a : pair.b) *= size;
    const Vec2 line = random_direction(random);
    const Vec2 aside = uniform(-0.5, 0.5, random) * Vec2(-line.y(), line.x());
    double near = 0, far = 3;
    const Points b = pair.b;
    const auto at = [&](double t) -> Points { return b.colwise() + (aside + t * line); };
    if (separation(pair.a, at(near)) >= 0) continue;
    for (int k = 0; k < 50; ++k) {
      const double middle = (near + far) / 2;
      (separation(pair.a, at(middle)) < 0 ? near : far) = middle;
    }
    pair.b = at(far + gap * size);
    if (separation(pair.a, pair.b) >= 0) return pair;
  }
}

/// The first t in (0, 1] at which vertex i comes onto the edge from j to k from outside, all moving evenly.
double first_meeting(const std::array<Vec2, 3>& from, const std::array<Vec2, 3>& to) {
  const auto at = [&](int p, double t) -> Vec2 { return (1 - t) * from[p] + t * to[p]; };
  const auto beyond = [&](double t) { return cross(at(0, t) - at(1, t), at(2, t) - at(1, t)); };
  // A quadratic polynomial by its values at 0, 1/2 and 1.
  const double c = beyond(0), half = beyond(0.5), one = beyond(1);
  const double b = 4 * half - one - 3 * c, a = one - b - c;
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  if (c < 0 || b * b < 4 * a * c) return never;
  const double q = -(b + std::copysign(root, b)) / 2;
  double first = never;
  for (const double t : {a == 0 ? never : q / a, q == 0 ? never : c / q}) {
    if (!(t > 0 && t <= 1) || t >= first) continue;
    const Vec2 along = at(2, t) - at(1, t);
    const double s = along.dot(at(0, t) - at(1, t)) / along.squaredNorm();
    if (2 * a * t + b < 0 && s >= 0 && s <= 1) first = t;
  }
  return first;
}

struct Meeting {
  double time = never;
  VertexEdge contact;
};

/// What two moving polygons meet first with, of all vertices and edges.
Meeting first_meeting(const PolygonPair& from, const PolygonPair& to) {
  Meeting first;
  for (int block : {0, 1})
    for (int v = 0; v < from.of(block).cols(); ++v)
      for (int e = 0; e < from.of(1 - block).cols(); ++e) {
        const VertexEdge c{block, v, 1 - block, e};
        const double t = first_meeting(std::array{from.vertex(c), from.start(c), from.end(c)},
                                       std::array{to.vertex(c), to.start(c), to.end(c)});
        if (t < first.time) first = {t, c};
      }
  return first;
}

/// Moved and turned at random so that no vertex goes further than `search_margin`.
Points moved_at_random(const Points& polygon, double search_margin, std::mt19937& random) {
  const Vec2 centre = polygon.rowwise().mean();
  const double radius = (polygon.colwise() - centre).colwise().norm().maxCoeff();
  const double turn = uniform(-1, 1, random) * std::min(0.5, search_margin / radius) * (random() % 2);
  const polyfem::Mat2 R = Eigen::Rotation2Dd(turn).toRotationMatrix();
  const double left = search_margin - std::abs(turn) * radius;
  const Vec2 by = centre + uniform(0, left, random) * random_direction(random);
  return (R * (polygon.colwise() - centre)).colwise() + by;
}

PolygonPair between(const PolygonPair& from, const PolygonPair& to, double t) {
  return {(1 - t) * from.a + t * to.a, (1 - t) * from.b + t * to.b};
}

/// Whether the vertex projects onto the edge or its collinear continuation.
bool is_over(const PolygonPair& pair, const VertexEdge& c) {
  const Vec2 along = (pair.end(c) - pair.start(c)).normalized();
  const double at = along.dot(pair.vertex(c) - pair.start(c)), length = (pair.end(c) - pair.start(c)).norm();
  const Points& polygon = pair.of(c.edge_block);
  return at >= -1e-9 - straight_length(polygon, c.edge, false) &&
         at <= length + 1e-9 + straight_length(polygon, c.edge, true);
}

double smaller_size(const PolygonPair& pair) {
  return std::sqrt(std::min(polyfem::signed_area(pair.a), polyfem::signed_area(pair.b)));
}

/// Counts what polygons meet first with and whether it is among the contacts found.
struct Meetings {
  int met = 0;
  int others = 0;        ///< not found itself
  int missed_sides = 0;  ///< of these, met away from the ends of the edge
  int unstopped = 0;     ///< of these, when no other contact was closed by then

  /// Moves each by up to half the reach.
  void add(const PolygonPair& pair, double search_margin, std::mt19937& random) {
    const PolygonPair to{moved_at_random(pair.a, search_margin / 2, random),
                         moved_at_random(pair.b, search_margin / 2, random)};
    const Meeting first = first_meeting(pair, to);
    if (first.time == never) return;
    ++met;
    const auto found = pair.contact_set(search_margin);
    if (found.contains(first.contact)) return;
    ++others;
    const PolygonPair then = between(pair, to, first.time);
    const Vec2 x = then.vertex(first.contact);
    const double from_ends =
        std::min((x - then.start(first.contact)).norm(), (x - then.end(first.contact)).norm());
    const bool stopped = std::any_of(found.begin(), found.end(), [&](const VertexEdge& c) {
      return then.gap(c) <= 1e-9 && (is_over(pair, c) || is_over(then, c));
    });
    missed_sides += from_ends >= search_margin;
    unstopped += !stopped;
  }
};

/// The contacts of two polygons whose vertices were numbered from others on, in the numbers before.
std::set<VertexEdge> numbered_back(const std::set<VertexEdge>& contacts, const PolygonPair& pair, int by_a,
                                   int by_b) {
  const auto back = [&](int block, int k) {
    return (k + (block == 0 ? by_a : by_b)) % static_cast<int>(pair.of(block).cols());
  };
  std::set<VertexEdge> result;
  for (const VertexEdge& c : contacts)
    result.insert({c.vertex_block, back(c.vertex_block, c.vertex), c.edge_block, back(c.edge_block, c.edge)});
  return result;
}

std::set<VertexEdge> mirrored_back(const std::set<VertexEdge>& contacts, const PolygonPair& pair) {
  std::set<VertexEdge> result;
  for (const VertexEdge& c : contacts) {
    const int n_v = static_cast<int>(pair.of(c.vertex_block).cols()),
              n_e = static_cast<int>(pair.of(c.edge_block).cols());
    result.insert({c.vertex_block, n_v - 1 - c.vertex, c.edge_block, (2 * n_e - 2 - c.edge) % n_e});
  }
  return result;
}

/// An L whose notch has its tip at the origin and opens to the right and upwards.
Points notched() {
  return points({{-1, -1}, {1, -1}, {1, 0}, {0, 0}, {0, 1}, {-1, 1}});
}

}  // namespace

/// Whatever two polygons meet with first, a contact stands in the way: the same, or, where corner meets
/// corner, nearly always one that is closed by then.
TEST(AnyPolygon, WhatMeetsFirstIsFound) {
  std::mt19937 random(21);
  Meetings count;
  for (int trial = 0; trial < 5000; ++trial) {
    const PolygonPair pair = nearly_touching_pair(std::pow(10, uniform(-6, -1, random)), random);
    count.add(pair, smaller_size(pair) * std::pow(10, uniform(-2, -0.6, random)), random);
  }
  EXPECT_GT(count.met, 1500);
  EXPECT_EQ(count.missed_sides, 0);
  EXPECT_LE(count.others, count.met / 500);
  EXPECT_LE(count.unstopped, count.met / 1500);
}

/// Blocks that go by many times the thickness of what is in their way: as far as any may in a step.
TEST(AnyPolygon, FastSmallPolygonsMeetThinOnes) {
  std::mt19937 random(27);
  Meetings count;
  for (int trial = 0; trial < 4000; ++trial) {
    const double thin = std::pow(10, uniform(-2.5, -1, random));
    const Points plate =
        trial % 2 ? box(-3, -thin, 6, thin)
                  : points({{-2, -thin}, {2, -thin}, {2, 0}, {thin, 0}, {thin, 1}, {0, 1}, {0, 0}, {-2, 0}});
    Points small = std::pow(10, -uniform(0.3, 1.3, random)) * random_shape(random);
    const double side = trial % 3 == 0 ? -1 : 1, gap = std::pow(10, uniform(-4, -1.5, random));
    const double low = side > 0 ? gap - small.row(1).minCoeff() : -thin - gap - small.row(1).maxCoeff();
    small.colwise() += Vec2(uniform(-1.8, 1.8, random), low);
    const PolygonPair pair{plate, small};
    if (separation(plate, small) < 0) continue;
    count.add(pair, 0.25 * smaller_size(pair), random);
  }
  EXPECT_GT(count.met, 500);
  EXPECT_EQ(count.missed_sides, 0);
  EXPECT_LE(count.unstopped, count.met / 500);
}

/// A little later, when nothing stopped them, the vertex that came in is inside through that edge.
TEST(AnyPolygon, AShallowOverlapIsFoundAtItsEdge) {
  std::mt19937 random(22);
  int overlaps = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const PolygonPair pair = nearly_touching_pair(1e-3, random);
    const double size = smaller_size(pair);
    const PolygonPair to{moved_at_random(pair.a, 0.02 * size, random),
                         moved_at_random(pair.b, 0.02 * size, random)};
    const Meeting met = first_meeting(pair, to);
    if (met.time == never || met.time > 0.95) continue;
    const PolygonPair then = between(pair, to, met.time), later = between(pair, to, met.time + 0.02);
    if (then.inset(met.contact) < 0.01 * size || later.gap(met.contact) > -3 * coincidence) continue;
    ++overlaps;
    EXPECT_TRUE(later.contact_set(0.05 * size).contains(met.contact)) << "trial " << trial;
  }
  EXPECT_GT(overlaps, 150);
}

TEST(AnyPolygon, WhatIsFoundDoesNotDependOnPlaceOrderNumbersOrMirror) {
  std::mt19937 random(23);
  std::size_t n_found = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const PolygonPair pair = nearly_touching_pair(std::pow(10, uniform(-5, -1, random)), random);
    const double search_margin = 0.2 * smaller_size(pair);
    const auto found = pair.contact_set(search_margin);
    n_found += found.size();
    EXPECT_EQ(found, pair.contact_set(search_margin, {}, true)) << "trial " << trial;
    EXPECT_EQ(found,
              pair.moved(uniform(0, 7, random), Vec2(uniform(-9, 9, random), 3)).contact_set(search_margin))
        << "trial " << trial;
    const int by_a = static_cast<int>(random() % pair.a.cols()),
              by_b = static_cast<int>(random() % pair.b.cols());
    EXPECT_EQ(found, numbered_back(pair.renumbered(by_a, by_b).contact_set(search_margin), pair, by_a, by_b))
        << "trial " << trial;
    EXPECT_EQ(found, mirrored_back(pair.mirrored().contact_set(search_margin), pair)) << "trial " << trial;
  }
  EXPECT_GT(n_found, 2000u);
}

/// At distances above the coincidence nothing is found in touch that is apart.
TEST(AnyPolygon, SeparatedPolygonsHaveNoPenetratedContact) {
  std::mt19937 random(24);
  for (int trial = 0; trial < 2000; ++trial) {
    const PolygonPair pair = nearly_touching_pair(std::pow(10, uniform(-5, -1, random)), random);
    const double search_margin = 0.2 * smaller_size(pair);
    for (const VertexEdge& c : pair.contacts(search_margin)) {
      if (pair.inset(c) < -coincidence) continue;
      EXPECT_GE(pair.gap(c), -1e-12) << "trial " << trial;
    }
  }
}

TEST(AnyPolygon, ACornerInANotchMeetsBothItsEdges) {
  for (const double depth : {0.05, 0.01, 1e-9, 0., -1e-9, -1e-7, -1e-4, -0.01}) {
    const PolygonPair pair{notched(), box(depth, depth, 0.3, 0.3)};
    for (const bool swapped : {false, true}) {
      const auto found = pair.contact_set(0.1, {}, swapped);
      EXPECT_TRUE(found.contains({1, 0, 0, 2})) << depth;
      EXPECT_TRUE(found.contains({1, 0, 0, 3})) << depth;
      // Besides, the far ends of the two sides that lie along.
      EXPECT_EQ(found.size(), 4u) << depth;
    }
  }
}

TEST(AnyPolygon, AReflexCornerMeetsNothing) {
  std::mt19937 random(25);
  for (int trial = 0; trial < 2000; ++trial) {
    const PolygonPair pair = nearly_touching_pair(std::pow(10, uniform(-5, -1, random)), random);
    for (const VertexEdge& c : pair.contacts(0.3))
      EXPECT_NE(corner_at(pair.of(c.vertex_block), c.vertex), Corner::reflex);
  }
}

/// Boxes with nodes along their sides, one on the other: each node stands on one edge, pairs of nodes at one
/// place make one contact, and the lengths add up to the overlap.
TEST(AnyPolygon, NodesAlongSidesMeetOneEdgeEach) {
  std::mt19937 random(26);
  for (int trial = 0; trial < 300; ++trial) {
    const auto with_nodes = [&](double x, double y, double width, double height, int n, bool on_top) {
      Points p(2, 4 + n);
      p.leftCols(4) = box(x, y, width, height);
      if (on_top) {
        p.col(3 + n) = p.col(3).eval();
        for (int k = 1; k <= n; ++k) p.col(2 + k) << x + width * (n + 1 - k) / (n + 1), y + height;
      } else {
        p.rightCols(3) = box(x, y, width, height).rightCols(3);
        for (int k = 1; k <= n; ++k) p.col(k) << x + width * k / (n + 1), y;
      }
      return p;
    };
    const int n = static_cast<int>(random() % 6), m = trial % 3 == 0 ? n : static_cast<int>(random() % 6);
    const double shift = trial % 3 == 0 ? 0 : uniform(-0.6, 0.6, random);
    const PolygonPair flat{with_nodes(0, -1, 2, 1, n, true), with_nodes(shift, 0, 2, 1, m, false)};
    const PolygonPair pair = flat.moved(uniform(0, 7, random), Vec2(1, 2));
    const auto found = pair.contact_set(0.3);
    double length = 0;
    std::set<std::array<int, 2>> vertices;
    for (const VertexEdge& c : found) {
      EXPECT_NEAR(pair.gap(c), 0, 1e-12);
      if (!is_over(pair, c)) continue;
      EXPECT_GE(pair.inset(c), -1e-12) << "not the edge that it is over";
      EXPECT_TRUE(vertices.insert({c.vertex_block, c.vertex}).second) << "a node on two edges";
      const auto bears = [&](int block, int vertex) {
        return std::ranges::any_of(found, [&](const VertexEdge& of) {
          return of.vertex_block == block && of.vertex == vertex && is_over(pair, of);
        });
      };
      length +=
          contact_length(pair.of(c.vertex_block), pair.of(c.edge_block), c, pair.of(c.vertex_block), bears)
              .total();
    }
    EXPECT_NEAR(length, 2 - std::abs(shift), 1e-9) << "trial " << trial << " nodes " << n << ", " << m;
    if (trial % 3 == 0) {
      EXPECT_EQ(found.size(), static_cast<std::size_t>(n + 2));
    }
  }
}

/// A tooth of a comb as thin as the reach: nothing meets its far side.
TEST(AnyPolygon, NothingMeetsTheFarSideOfAThinLeg) {
  const Points comb = points({{0, 0}, {3, 0}, {3, 1}, {2.05, 1}, {2.05, 4}, {2, 4}, {2, 1}, {0, 1}});
  for (const double gap : {0.04, 1e-3, 0., -1e-7, -1e-3}) {
    const PolygonPair pair{comb, box(2.05 + gap, 2, 0.5, 0.5)};
    EXPECT_EQ(pair.contact_set(0.2), (std::set<VertexEdge>{{1, 0, 0, 3}, {1, 3, 0, 3}})) << gap;
  }
}
