// Pieces fill what was cut, and share their vertices bit for bit.
#include "convex_cutting.hpp"

#include "random_polygon.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>

using namespace support;

namespace {

Line random_line(std::mt19937& random) {
  return {Vec2(uniform(-1, 1, random), uniform(-1, 1, random)), random_direction(random)};
}

double area(const std::vector<Points>& polygons) {
  double sum = 0;
  for (const Points& polygon : polygons) sum += polyfem::signed_area(polygon);
  return sum;
}

}  // namespace

TEST(ConvexCutting, PiecesFillThePolygonAndAreNoSlivers) {
  std::mt19937 random(1);
  const Sliver sliver{1e-3, 0.1};
  for (int n = 3; n < 9; ++n) {
    std::vector<Points> pieces{random_convex_polygon(n, random)};
    const double whole = area(pieces);
    for (int k = 0; k < 12; ++k) pieces = cut(pieces, random_line(random), sliver);
    EXPECT_GT(pieces.size(), 3u);
    EXPECT_NEAR(area(pieces), whole, 1e-13);
    for (const Points& piece : pieces) EXPECT_FALSE(is_sliver(piece, sliver));
  }
}

TEST(ConvexCutting, NeighboursShareVerticesToTheLastBit) {
  // Every directed edge that is not on the outline is another piece's edge the other way round.
  std::mt19937 random(2);
  Points square(2, 4);
  square << -1, 1, 1, -1, -1, -1, 1, 1;
  std::vector<Points> pieces{square};
  for (int k = 0; k < 10; ++k) pieces = cut(pieces, random_line(random), {});
  using Vertex = std::pair<double, double>;
  std::map<std::pair<Vertex, Vertex>, int> edges;
  for (const Points& piece : pieces)
    for (Eigen::Index k = 0; k < piece.cols(); ++k) {
      const Vec2 from = piece.col(k), to = piece.col((k + 1) % piece.cols());
      ++edges[{{from.x(), from.y()}, {to.x(), to.y()}}];
    }
  int inside = 0;
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    const Vec2 middle((edge.first.first + edge.second.first) / 2,
                      (edge.first.second + edge.second.second) / 2);
    if (middle.cwiseAbs().maxCoeff() > 1 - 1e-9) continue;
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    ++inside;
  }
  EXPECT_GT(inside, 50);
}

TEST(ConvexCutting, SliversAreToldByAreaAndByCorner) {
  Points triangle(2, 3);
  triangle << 0, 1, 1, 0, 0, 0.1;
  EXPECT_FALSE(is_sliver(triangle, {0.04, 0.09}));
  EXPECT_TRUE(is_sliver(triangle, {0.06, 0.09}));
  EXPECT_TRUE(is_sliver(triangle, {0.04, 0.11}));
}
