#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/cut_grid.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace polyfem;

namespace {

double total_area(const PolygonMesh& mesh) {
  double area = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) area += signed_area(mesh.outline(c));
  return area;
}

TEST(CutGrid, FillsADomainWithValidCells) {
  const Points star = support::star(7);
  for (const double spacing : {1., 0.37, 0.05})
    for (const double smallest : {0., 0.05, 0.3}) {
      const PolygonMesh mesh = cut_grid(star, spacing, Vec2(0.01, -0.02), smallest);
      EXPECT_NO_THROW(require_valid(mesh));
      EXPECT_NEAR(total_area(mesh) / signed_area(star), 1, 1e-12);
      for (Index corner = 0; corner < star.cols(); ++corner)
        EXPECT_EQ((mesh.vertices.colwise() - star.col(corner)).colwise().norm().minCoeff(), 0);
    }
}

TEST(CutGrid, SquaresInsideAreWhole) {
  const PolygonMesh mesh = cut_grid(support::rectangle(4, 3), 1, Vec2(0.5, 0.5), 0);
  EXPECT_EQ(mesh.n_cells(), 20);
  int n_whole = 0;
  for (int c = 0; c < mesh.n_cells(); ++c)
    n_whole += mesh.cell(c).size() == 4 && std::abs(signed_area(mesh.outline(c)) - 1) < 1e-13;
  EXPECT_EQ(n_whole, 6);
}

TEST(CutGrid, SmallCellsAreJoinedToNeighbours) {
  const Points triangle = support::polygon_of({{0, 0}, {10, 0.3}, {4, 8}});
  const auto smallest = [&](const PolygonMesh& mesh) {
    double area = std::numeric_limits<double>::infinity();
    for (int c = 0; c < mesh.n_cells(); ++c) area = std::min(area, signed_area(mesh.outline(c)));
    return area;
  };
  const PolygonMesh all = cut_grid(triangle, 0.5, Vec2::Zero(), 0),
                    joined = cut_grid(triangle, 0.5, Vec2::Zero(), 0.2);
  EXPECT_LT(smallest(all), 0.01 * 0.25);
  EXPECT_GE(smallest(joined), 0.2 * 0.25);
  EXPECT_LT(joined.n_cells(), all.n_cells());
}

TEST(CutGrid, RefusesImpossibleGrids) {
  const Points square = support::rectangle(1, 1);
  for (const double spacing : {0., -1., 1e-7, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(cut_grid(square, spacing, Vec2::Zero()), Error);
  EXPECT_THROW(cut_grid(square, 0.1, Vec2::Zero(), 1), Error);
}

}  // namespace
