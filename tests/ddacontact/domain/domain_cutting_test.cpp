/// \file Blocks cut from a domain fill it, share their vertices and know the joints between them.
#include <ddacontact/domain/domain_cutting.hpp>
#include <ddacontact/domain/opening_shapes.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>

#include "../../support/random_domains.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

namespace {

using namespace ddacontact;
using polyfem::signed_area;

Points rectangle(double width, double height) {
  Points corners(2, 4);
  corners << 0, width, width, 0, 0, 0, height, height;
  return corners;
}

/// A rectangle that nothing cuts.
Domain box(double width, double height) {
  Domain domain;
  domain.boundary = rectangle(width, height);
  return domain;
}

/// Square blocks: one for each whole square of the rectangle, joint 0 between columns and 1 between rows.
Domain squares(double width, double height) {
  Domain domain = box(width, height);
  domain.joint_sets = {{.joint = 0, .angle = 90, .origin = {1, 0}}, {.joint = 1, .angle = 0}};
  return domain;
}

JointTrace trace(std::initializer_list<Vec2> points, int joint = 5) {
  JointTrace result{joint, Points(2, static_cast<Index>(points.size()))};
  Index k = 0;
  for (const Vec2& point : points) result.points.col(k++) = point;
  return result;
}

/// Of the directed edges of all blocks.
using EdgeMap = std::map<std::array<double, 4>, int>;
EdgeMap edges_of(const CutDomain& cut) {
  EdgeMap edges;
  for (const CutBlock& block : cut.blocks)
    for (Index k = 0; k < block.outline.cols(); ++k) {
      const Vec2 from = block.outline.col(k), to = block.outline.col((k + 1) % block.outline.cols());
      const bool is_new = edges.insert({{from.x(), from.y(), to.x(), to.y()}, block.joints[k]}).second;
      EXPECT_TRUE(is_new);
    }
  return edges;
}

/// Blocks of random domains are simple polygons, add up to the domain and meet in whole edges.
void expect_filled_by_simple_blocks(std::uint32_t first_seed, std::uint32_t last_seed) {
  for (std::uint32_t seed = first_seed; seed <= last_seed; ++seed) {
    const Domain domain = support::random_domain(seed);
    const CutDomain cut = cut_domain(domain);
    const double area = std::abs(signed_area(domain.boundary));
    ASSERT_NEAR(cut.counts.area, area, 1e-12 * area) << seed;
    for (const CutBlock& block : cut.blocks) {
      ASSERT_FALSE(polyfem::find_defect(block.outline)) << seed;
      ASSERT_GT(signed_area(block.outline), 0) << seed;
      ASSERT_EQ(block.joints.size(), block.outline.cols()) << seed;
    }
    const EdgeMap edges = edges_of(cut);  // blocks that overlap would share an edge in the same direction
    if (!domain.keep_t_vertices) continue;
    double outline = 0, perimeter = 0;
    for (const auto& [edge, joint] : edges) {
      const auto beyond = edges.find({edge[2], edge[3], edge[0], edge[1]});
      if (beyond != edges.end())
        ASSERT_EQ(beyond->second, joint) << seed;
      else
        outline += std::hypot(edge[2] - edge[0], edge[3] - edge[1]);
    }
    for (Index k = 0; k < domain.boundary.cols(); ++k)
      perimeter += (domain.boundary.col((k + 1) % domain.boundary.cols()) - domain.boundary.col(k)).norm();
    ASSERT_NEAR(outline, perimeter, 1e-9 * perimeter) << seed;
  }
}

TEST(DomainCutting, RandomDomainsAreFilledBySimpleBlocks) {
  expect_filled_by_simple_blocks(1, 300);
}
TEST(DomainCutting, TenThousandRandomDomainsAreFilledBySimpleBlocks) {
  expect_filled_by_simple_blocks(301, 10000);
}

TEST(DomainCutting, TwoSetsGiveRowsOfSquares) {
  const CutDomain cut = cut_domain(squares(4, 3));
  ASSERT_EQ(cut.counts.blocks, 12);
  for (int b = 0; b < 12; ++b) {
    const Points& square = cut.blocks[b].outline;
    EXPECT_EQ(square.cols(), 4);
    EXPECT_LE((square.col(0) - Vec2(b % 4, b / 4)).norm(), 1e-12);
  }
  EXPECT_EQ(cut.blocks[5].joints, (std::vector{1, 0, 1, 0}));
  EXPECT_EQ(cut.blocks[0].joints, (std::vector{-1, 0, 1, -1}));
  EXPECT_EQ(cut.counts.dangling_removed + cut.counts.connecting_joints + cut.counts.t_vertices, 0);
}

TEST(DomainCutting, EdgesLieAlongTheSetThatCutThem) {
  Domain domain = box(20, 10);
  domain.joint_sets = {{.joint = 3, .angle = 60, .spacing = 2}, {.joint = 7, .angle = -20, .spacing = 1.5}};
  int n_joints = 0;
  for (const CutBlock& block : cut_domain(domain).blocks)
    for (Index k = 0; k < block.outline.cols(); ++k) {
      if (block.joints[k] < 0) continue;
      const Vec2 along = block.outline.col((k + 1) % block.outline.cols()) - block.outline.col(k);
      const double angle = (block.joints[k] == 3 ? 60 : -20) * std::numbers::pi / 180;
      EXPECT_LE(std::abs(polyfem::cross(along.normalized(), Vec2(std::cos(angle), std::sin(angle)))), 1e-9);
      ++n_joints;
    }
  EXPECT_GT(n_joints, 300);
}

TEST(DomainCutting, TheSameSeedGivesTheSameBytes) {
  Domain domain = squares(20, 20);
  domain.joint_sets[0].spacing_deviation = domain.joint_sets[1].angle_deviation = 0.3;
  const CutDomain one = cut_domain(domain), again = cut_domain(domain);
  ASSERT_EQ(one.blocks.size(), again.blocks.size());
  for (std::size_t b = 0; b < one.blocks.size(); ++b)
    EXPECT_EQ(one.blocks[b].outline, again.blocks[b].outline);
  domain.seed = 2;
  EXPECT_NE(cut_domain(domain).blocks[0].outline, one.blocks[0].outline);
}

/// By round-off its line has a point of its own beside the corner.
TEST(DomainCutting, AJointMayPassThroughACornerOfTheDomainAnywhere) {
  for (const double angle : {91., 95., 100., 120., 135.})
    for (double x = 0; x < 400; x += 10) {
      Domain domain;
      domain.boundary = rectangle(20, 12).colwise() + Vec2(x, 0);
      domain.joint_sets = {{.angle = angle, .spacing = 3, .origin = {x, 0}}};
      for (const CutBlock& block : cut_domain(domain).blocks)
        EXPECT_FALSE(polyfem::find_defect(block.outline)) << angle << ' ' << x;
    }
}

/// A joint without rock bridges is one line, wherever the domain is: its angle scatters as a whole.
TEST(DomainCutting, PersistentJointsOfScatteredAnglesCutThrough) {
  for (const double from : {-50., 0., 1e5}) {
    Domain domain;
    domain.boundary = rectangle(100, 10).colwise() + Vec2(from, -5);
    domain.joint_sets = {{.angle = 90, .angle_deviation = 0.1, .spacing = 4, .origin = {1, 0}}};
    EXPECT_EQ(cut_domain(domain).counts.blocks, 26) << from;
  }
}

TEST(DomainCutting, JointsEndAtTheLastJointThatTheyCross) {
  Domain domain = box(4, 2);
  domain.traces = {trace({{2, -1}, {2, 3}}), trace({{1, 1}, {3, 1}}), trace({{0.2, 0.5}, {0.7, 1.5}})};
  const CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 2);
  EXPECT_EQ(cut.counts.dangling_removed, 3);
  for (const CutBlock& block : cut.blocks) EXPECT_EQ(block.outline.cols(), 4);
}

TEST(DomainCutting, TracesMayEndALittleBeforeTheLineThatTheyMean) {
  Domain domain = box(4, 2);
  domain.traces = {trace({{2, 0.004}, {1.99, 1.996}})};
  EXPECT_EQ(cut_domain(domain).counts.blocks, 1);
  domain.snap = 0.005;
  const CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 2);
  EXPECT_NEAR(cut.counts.area, 8, 1e-12);
}

/// Bed joints of a wall and head joints that end 2 mm before the bed above: as drawn they divide nothing.
TEST(DomainCutting, LinesThatEndTooEarlyAreCounted) {
  for (const double missing : {0.0, 0.002, 0.2}) {
    Domain domain = box(4, 2);
    domain.traces = {trace({{0, 1}, {4, 1}}), trace({{1, 0}, {1, 1 - missing}}),
                     trace({{3, 0}, {3, 1 - missing}})};
    const auto counts = cut_domain(domain).counts;
    EXPECT_EQ(counts.blocks, missing == 0 ? 4 : 2);
    EXPECT_EQ(counts.cut_by_longer, missing == 0.002 ? 2 : 0);
    EXPECT_EQ(counts.dangling_removed, missing == 0 ? 0 : 2);
  }
}

TEST(DomainCutting, VerticesWithinTheSnappingDistanceBecomeOne) {
  Domain domain = box(4, 4);
  domain.traces = {trace({{0, 0}, {4, 4}}), trace({{0, 4}, {4, 0}}), trace({{0, 2}, {4, 2.001}})};
  domain.sliver_policy = SliverPolicy::keep;
  EXPECT_EQ(cut_domain(domain).counts.blocks, 7);  // a tiny triangle in the middle
  domain.snap = 0.01;
  const CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 6);
  EXPECT_EQ(cut.counts.slivers_left, 0);
}

TEST(DomainCutting, TVerticesAreOnlyOfTheBlocksThatEndThere) {
  Domain domain = box(4, 2);
  domain.traces = {trace({{0, 1}, {4, 1}}), trace({{2, 1}, {2, 2}})};
  CutDomain cut = cut_domain(domain);
  ASSERT_EQ(cut.counts.blocks, 3);
  EXPECT_EQ(cut.counts.t_vertices, 1);
  EXPECT_EQ(cut.blocks[1].outline.cols(), 4);  // the lower one
  domain.keep_t_vertices = true;
  cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.t_vertices, 0);
  EXPECT_EQ(cut.blocks[1].outline.cols(), 5);
}

TEST(DomainCutting, NoBlockSurroundsOthers) {
  Domain domain = box(10, 10);
  domain.openings = {{circle_outline({5, 5}, 2, 24), 4}};
  domain.traces = {trace({{1, 1}, {2, 1}, {2, 2}, {1, 1}})};
  const CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.connecting_joints, 4);
  EXPECT_NEAR(cut.counts.area, 100, 1e-10);
  int n_inside = 0;
  for (const CutBlock& block : cut.blocks) {
    EXPECT_FALSE(polyfem::find_defect(block.outline));
    n_inside += static_cast<int>(block.openings.size());
  }
  EXPECT_EQ(n_inside, 1);
}

TEST(DomainCutting, NoBlockTouchesItselfInAVertex) {
  Domain domain = box(10, 10);
  domain.traces = {trace({{5, 0}, {7, 3}, {3, 3}, {5, 0}})};
  const CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.connecting_joints, 1);
  for (const CutBlock& block : cut.blocks) EXPECT_FALSE(polyfem::find_defect(block.outline));
}

TEST(DomainCutting, SliversAreMergedKeptOrRefused) {
  Domain domain = squares(5, 5);
  domain.traces = {trace({{1.001, 0}, {1.001, 5}})};
  domain.sliver.area = 0.01;
  CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 25);
  EXPECT_EQ(cut.counts.slivers_merged, 5);
  domain.sliver_policy = SliverPolicy::keep;
  cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 30);
  EXPECT_EQ(cut.counts.slivers_left, 5);
  domain.sliver_policy = SliverPolicy::refuse;
  EXPECT_THROW(cut_domain(domain), polyfem::Error);
}

TEST(DomainCutting, SliversOfAnOpeningAreNotMergedAcrossItsOutline) {
  Domain domain = box(10, 10);
  domain.openings = {{rectangle(5, 1e-3), -1}};
  domain.traces = {trace({{5, 0}, {5, 10}})};
  domain.sliver.area = 0.01;
  EXPECT_EQ(cut_domain(domain).counts.slivers_merged, 0);
  EXPECT_EQ(cut_domain(domain).counts.slivers_left, 1);
}

TEST(DomainCutting, SharpCornersGoWhereAMergeTakesThemAway) {
  Domain domain = box(10, 10);
  domain.traces = {trace({{0, 5}, {10, 5}}), trace({{0, 5}, {10, 5.5}}), trace({{8, 0}, {8, 10}})};
  const CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.slivers_merged, 1);
  EXPECT_EQ(cut.counts.slivers_left, 0);
}

TEST(DomainCutting, SetsAndCellsKeepToTheirRegions) {
  Domain domain = box(20, 10);
  domain.regions = {{rectangle(10, 10), true, 8}};
  domain.joint_sets = {{.joint = 1, .angle = 0, .spacing = 1, .origin = {0, 0}, .region = 0}};
  CutDomain cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 11);
  domain.joint_sets.clear();
  domain.voronoi = {{2, 0, 30}};
  cut = cut_domain(domain);
  EXPECT_EQ(cut.counts.blocks, 31);
  int n_in_region = 0;
  for (const CutBlock& block : cut.blocks) n_in_region += static_cast<int>(block.regions.size());
  EXPECT_EQ(n_in_region, 30);
}

/// An angle of rock with an inner corner belongs to the region that it lies in, not to that of its centroid.
TEST(DomainCutting, ConcaveBlocksBelongToTheRegionThatTheyLieIn) {
  Domain domain = box(4, 4);
  const Points angle = (Points(2, 6) << 0, 4, 4, 1, 1, 0, 0, 0, 1, 1, 4, 4).finished();
  domain.regions = {{angle, true, 0}, {(Points(2, 4) << 1, 4, 4, 1, 1, 1, 4, 4).finished(), true, 0}};
  const CutDomain cut = cut_domain(domain);
  ASSERT_EQ(cut.blocks.size(), 2u);
  for (const CutBlock& block : cut.blocks)
    EXPECT_EQ(block.regions, std::vector<int>{block.outline.cols() == 6 ? 0 : 1});
}

TEST(DomainCutting, RockBridgesAreShiftedFromLineToLine) {
  Domain domain = box(8, 4);
  domain.joint_sets = {{.joint = 0, .angle = 0},
                       {.joint = 1, .angle = 90, .spacing = 1, .trace = 1, .gap = 1, .origin = {1, 0.5}}};
  const CutDomain cut = cut_domain(domain);  // running bond: bricks 2 m long
  EXPECT_EQ(cut.counts.blocks, 18);
  EXPECT_EQ(cut.counts.dangling_removed, 0);
}

TEST(DomainCutting, IsTheSameFarFromTheOrigin) {
  Domain domain = support::random_domain(12);
  const CutDomain here = cut_domain(domain);
  const Vec2 far(500000, 4000000);
  domain.boundary.colwise() += far;
  for (JointSet& set : domain.joint_sets) set.origin += far;
  for (JointTrace& line : domain.traces) line.points.colwise() += far;
  for (DomainOpening& opening : domain.openings) opening.outline.colwise() += far;
  for (DomainRegion& region : domain.regions) region.polygon.colwise() += far;
  const CutDomain there = cut_domain(domain);
  EXPECT_EQ(there.counts.blocks, here.counts.blocks);
  EXPECT_NEAR(there.counts.area, here.counts.area, 1e-7);
}

TEST(DomainCutting, RefusesMoreBlocksThanItCanCut) {
  Domain domain = squares(4, 4);
  domain.joint_sets[0].spacing = domain.joint_sets[1].spacing = 1e-4;
  try {
    cut_domain(domain);
    FAIL();
  } catch (const polyfem::Error& error) {
    EXPECT_NE(std::string(error.what()).find("about 1.6e+09 blocks"), std::string::npos) << error.what();
  }
}

TEST(DomainCutting, RefusesOutlinesThatCrossThemselves) {
  Domain domain = box(4, 4);
  domain.boundary.col(2).swap(domain.boundary.col(3));
  EXPECT_THROW(cut_domain(domain), polyfem::Error);
}

TEST(OpeningShapes, HaveTheirMeasures) {
  const Points circle = circle_outline({1, 2}, 3, 48), shoe = horseshoe_outline({0, -1}, 4, 5, 24);
  EXPECT_NEAR(signed_area(circle), 9 * std::numbers::pi, 0.1);
  EXPECT_NEAR(signed_area(shoe), 4 * 3 + 2 * std::numbers::pi, 0.03);
  EXPECT_EQ(shoe.row(1).minCoeff(), -1);
  EXPECT_NEAR(shoe.row(1).maxCoeff(), 4, 1e-12);
  EXPECT_FALSE(polyfem::find_defect(horseshoe_outline({0, 0}, 4, 2, 12)));
}

}  // namespace
