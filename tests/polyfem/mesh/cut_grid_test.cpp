#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/cut_grid.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

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

TEST(CutGrid, HolesAreLeftOutAndSidesNamed) {
  Points circle(2, 24);
  for (int k = 0; k < 24; ++k) {
    const double angle = std::numbers::pi / 12 * k;
    circle.col(k) << 1.7 + 0.7 * std::cos(angle), 1.4 + 0.7 * std::sin(angle);
  }
  GridDomain plate{.outline = support::rectangle(4, 3),
                   .holes = {circle, support::polygon_of({{3.3, 2.3}, {3.6, 2.3}, {3.5, 2.6}})},
                   .sides = {{"left", {{0, 3}}}, {"straight", {{0, 0}, {0, 1}, {0, 2}, {0, 3}}}}};
  for (int k = 0; k < 24; ++k) plate.sides["round"].push_back({1, k});
  plate.sides["small"] = {{2, 0}, {2, 1}, {2, 2}};
  const double area = 12 - signed_area(plate.holes[0]) - signed_area(plate.holes[1]);
  for (const double spacing : {2., 0.5, 0.11})
    for (const double smallest : {0., 0.1}) {
      const NamedMesh named = cut_grid(plate, spacing, Vec2(0.01, -0.02), smallest);
      EXPECT_NO_THROW(require_valid(named.mesh));
      EXPECT_NEAR(total_area(named.mesh) / area, 1, 1e-12);
      const auto length = [&](const std::string& group) {
        double sum = 0;
        for (const auto& [a, b] : named.edges(group))
          sum += (named.mesh.vertices.col(b) - named.mesh.vertices.col(a)).norm();
        return sum;
      };
      EXPECT_NEAR(length("left"), 3, 1e-12);
      EXPECT_NEAR(length("straight"), 14, 1e-12);
      EXPECT_NEAR(length("round"), 24 * 2 * 0.7 * std::sin(std::numbers::pi / 24), 1e-12);
      EXPECT_NEAR(length("small"), 0.3 + std::hypot(0.1, 0.3) + std::hypot(0.2, 0.3), 1e-12);
      EXPECT_EQ(named.edges("straight").size() + named.edges("round").size() + named.edges("small").size(),
                boundary_edges(named.mesh).size());
      for (const Points& hole : plate.holes)
        for (const auto corner : hole.colwise())
          EXPECT_EQ((named.mesh.vertices.colwise() - corner).colwise().norm().minCoeff(), 0);
    }
}

TEST(CutGrid, RefusesHolesAndSidesThatAreNotThere) {
  const Points square = support::rectangle(1, 1), half = support::rectangle(0.5, 0.5);
  const auto cut = [&](const GridDomain& domain) { return cut_grid(domain, 0.2, Vec2::Zero()); };
  Points shifted = half;
  shifted.colwise() += Vec2(0.3, 0.3);
  EXPECT_NO_THROW(cut({square, {shifted}, {}}));
  EXPECT_THROW(cut({square, {(shifted.array() + 0.4).matrix()}, {}}), Error) << "outside";
  EXPECT_THROW(cut({square, {shifted, (shifted.array() + 0.1).matrix()}, {}}), Error) << "overlap";
  EXPECT_THROW(cut({square, {support::polygon_of({{0.2, 0.2}, {0.8, 0.8}, {0.8, 0.2}, {0.2, 0.8}})}, {}}),
               Error)
      << "not simple";
  EXPECT_THROW(cut({square, {shifted}, {{"top", {{0, 4}}}}}), Error);
  EXPECT_THROW(cut({square, {shifted}, {{"top", {{2, 0}}}}}), Error);
}

TEST(CutGrid, RefusesImpossibleGrids) {
  const Points square = support::rectangle(1, 1);
  for (const double spacing : {0., -1., 1e-7, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(cut_grid(square, spacing, Vec2::Zero()), Error);
  EXPECT_THROW(cut_grid(square, 0.1, Vec2::Zero(), 1), Error);
}

}  // namespace
