// Slopes are what their description says, whatever the seed.
#include "random_slopes.hpp"

#include "convex_cutting.hpp"
#include "limit_analysis.hpp"
#include "overlap_area.hpp"
#include "rigid_rock.hpp"

#include <polyfem/geometry/area_moments.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

using namespace support;
using ddacontact::BlockDescription;
using ddacontact::Scene;

namespace {

long n_free(const Scene& scene) {
  return std::count_if(scene.blocks.begin(), scene.blocks.end(),
                       [](const BlockDescription& block) { return !block.fixed; });
}

}  // namespace

TEST(RandomSlopes, HaveAsManyBlocksAsAsked) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    EXPECT_GE(n_free(random_slope(seed)), 20);
    EXPECT_LE(n_free(random_slope(seed)), 60);
  }
  EXPECT_GE(n_free(random_slope(1, {190, 210})), 190);
  EXPECT_LE(n_free(random_slope(1, {190, 210})), 210);
}

TEST(RandomSlopes, FreeBlocksAreNoSlivers) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Scene scene = random_slope(seed);
    double area = 0;
    for (const BlockDescription& block : scene.blocks)
      if (!block.fixed) area += polyfem::signed_area(block.vertices) / static_cast<double>(n_free(scene));
    for (const BlockDescription& block : scene.blocks) {
      if (block.fixed) continue;
      EXPECT_FALSE(is_sliver(block.vertices, {5e-3 * area, 9.99 * std::numbers::pi / 180})) << seed;
    }
  }
}

TEST(RandomSlopes, JointsAreClosedAndBlocksDoNotOverlap) {
  // Every face of a free block is covered by its neighbours' or lies on the slope's face or crest.
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Scene scene = random_slope(seed);
    std::vector<Points> outlines;
    for (const BlockDescription& block : scene.blocks) outlines.push_back(block.vertices);
    double covered = 0, around = 0, surface = 0;
    const std::vector<ContactPoint> points = touching_faces(outlines).points;
    for (std::size_t k = 0; k + 1 < points.size(); k += 2) {
      const double length = (points[k].at - points[k + 1].at).norm();
      for (const int block : {points[k].one, points[k].other})
        if (!scene.blocks[static_cast<std::size_t>(block)].fixed) covered += length;
    }
    Vec2 crest(1e9, 20);
    for (const Points& outline : outlines)
      for (const auto& vertex : outline.colwise())
        if (vertex.y() > 20 - 1e-9 && vertex.x() < crest.x()) crest = vertex;
    const Line face{crest, crest.normalized()}, level{crest, Vec2(1, 0)};  // the toe is the origin
    for (std::size_t b = 0; b < outlines.size(); ++b) {
      if (scene.blocks[b].fixed) continue;
      for (std::size_t other = 0; other < b; ++other)
        EXPECT_LT(overlap_area_of_convex(outlines[b], outlines[other]), 1e-9);
      for (Eigen::Index k = 0; k < outlines[b].cols(); ++k) {
        const Vec2 from = outlines[b].col(k), to = outlines[b].col((k + 1) % outlines[b].cols());
        around += (to - from).norm();
        for (const Line& line : {face, level})
          if (std::max(std::abs(line.left(from)), std::abs(line.left(to))) < 1e-6)
            surface += (to - from).norm();
      }
    }
    EXPECT_NEAR(covered + surface, around, 1e-6 * around) << seed;
  }
}

TEST(SteepestDip, IsThatOfTheSteepestFaceThatBears) {
  Points wedge(2, 3), left(2, 4), right(2, 4);
  wedge << 0, 1, -2, 0, 2, 2;  // between faces of 63.4 and 45 degrees
  left << 0, -2, -2, -1, 0, 2, -1, -1;
  right << 0, 3, 3, 1, 0, 0, 2, 2;
  Scene scene = rigid_rock();
  for (const Points& outline : {wedge, left, right}) {
    scene.blocks.push_back(rock_block(outline, !scene.blocks.empty()));
  }
  EXPECT_NEAR(steepest_dip(rigid_blocks(scene)), std::atan(2), 1e-9);
}
