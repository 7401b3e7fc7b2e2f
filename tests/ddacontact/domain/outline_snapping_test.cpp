/// \file Polygons drawn with rounded coordinates touch once they are snapped.
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/outline_snapping.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include "../../support/random_polygon.hpp"

#include <gtest/gtest.h>

#include <set>

namespace {

using polyfem::Index;
using polyfem::Points;
using polyfem::Vec2;

TEST(OutlineSnapping, CellsDrawnToCentimetresShareTheirVertices) {
  Points domain(2, 4);
  domain << 0, 20, 20, 0, 0, 0, 10, 10;
  const polyfem::PolygonMesh mesh = polyfem::voronoi(domain, {.n_cells = 150});
  std::mt19937 random(7);
  std::vector<Points> cells;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    cells.push_back(mesh.outline(c));
    for (double& x : cells.back().reshaped())
      x = std::round(100 * (x + support::uniform(-.004, .004, random))) / 100;
  }
  const std::vector<Points> drawn = cells;
  const polyfem::Snapping snapping = polyfem::snap_outlines(cells, 0.03);
  EXPECT_FALSE(snapping.collapsed);
  EXPECT_GT(snapping.n_moved, 100);
  std::set<std::pair<double, double>> vertices;
  double area = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    EXPECT_LE((cells[c] - drawn[c]).colwise().norm().maxCoeff(), 0.06);
    EXPECT_FALSE(polyfem::find_defect(cells[c]));
    area += polyfem::signed_area(cells[c]);
    for (const auto& vertex : cells[c].colwise()) vertices.insert({vertex.x(), vertex.y()});
  }
  EXPECT_EQ(static_cast<Index>(vertices.size()), mesh.vertices.cols());
  EXPECT_NEAR(area, 200, 0.5);
}

TEST(OutlineSnapping, VerticesMoveOntoEdgesThatTheyAreNear) {
  Points wall(2, 4), brick(2, 4);
  wall << 0, 9, 9, 0, 0, 0, 2, 3;
  brick << 4, 6, 6, 4, 2.6, 2.3, 4, 4;
  std::vector<Points> outlines{wall, brick};
  polyfem::snap_outlines(outlines, 0.1);
  EXPECT_EQ(outlines[0], wall);
  for (const int k : {0, 1}) {
    const Vec2 corner = outlines[1].col(k);
    EXPECT_NEAR(corner.y(), 3 - corner.x() / 9, 1e-14);
  }
}

TEST(OutlineSnapping, NothingMovesWhereAPolygonWouldLoseAVertex) {
  Points needle(2, 3);
  needle << 0, 5, 5, 0, 0, 0.01;
  std::vector<Points> outlines{needle};
  EXPECT_EQ(polyfem::snap_outlines(outlines, 0.1).collapsed, 0);
  EXPECT_EQ(outlines[0], needle);
}

}  // namespace
