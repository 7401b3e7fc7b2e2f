#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <ostream>

using namespace polyfem;

namespace {

const Vec2 low(-1, 0.1), high(0.3, 1.7);

struct Generator {
  const char* name;
  std::function<PolygonMesh(int n_x, int n_y)> make;
  std::function<int(int n_x, int n_y)> n_cells;
};
void PrintTo(const Generator& generator, std::ostream* out) {
  *out << generator.name;
}

int cells_in_bond(int n_x, int n_y) {
  return n_x * n_y + n_y / 2;
}
const Generator generators[] = {
    {"rectangles", [](int n_x, int n_y) { return rectangles(low, high, n_x, n_y); }, std::multiplies<int>()},
    {"one_way_triangles", [](int n_x, int n_y) { return triangles(low, high, n_x, n_y, Diagonals::one_way); },
     [](int n_x, int n_y) { return 2 * n_x * n_y; }},
    {"alternating_triangles", [](int n_x, int n_y) { return triangles(low, high, n_x, n_y); },
     [](int n_x, int n_y) { return 2 * n_x * n_y; }},
    {"hexagons", [](int n_x, int n_y) { return hexagons(low, high, n_x, n_y); }, cells_in_bond},
    {"bricks", [](int n_x, int n_y) { return bricks(low, high, n_x, n_y); }, cells_in_bond},
    {"two_sizes", [](int n_x, int n_y) { return rectangles_of_two_sizes(low, high, n_x, n_y); },
     [](int n_x, int n_y) { return 5 * n_x * n_y; }},
    {"chevrons", [](int n_x, int n_y) { return chevrons(low, high, n_x + 1, n_y, 0.7); },
     [](int n_x, int n_y) { return (n_x + 1) * n_y; }}};

class Generators : public testing::TestWithParam<Generator> {
 protected:
  static constexpr std::array<int, 2> sizes[] = {{1, 1}, {1, 2}, {2, 1}, {3, 4}, {7, 5}};
};
INSTANTIATE_TEST_SUITE_P(Kinds, Generators, testing::ValuesIn(generators),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(Generators, FillTheRectangleWithSoundCells) {
  for (const auto [n_x, n_y] : sizes) {
    const PolygonMesh mesh = GetParam().make(n_x, n_y);
    EXPECT_EQ(mesh.n_cells(), GetParam().n_cells(n_x, n_y));
    EXPECT_NO_THROW(require_valid(mesh));
    double area = 0;
    for (int c = 0; c < mesh.n_cells(); ++c) area += signed_area(mesh.outline(c));
    EXPECT_NEAR(area, (high - low).prod(), 1e-14 * mesh.n_cells());
  }
}

TEST_P(Generators, HaveTheRectangleAsBoundary) {
  for (const auto [n_x, n_y] : sizes) {
    const PolygonMesh mesh = GetParam().make(n_x, n_y);
    double length = 0;
    int n_corners = 0;
    for (const auto& [first, second] : boundary_edges(mesh)) {
      const Vec2 a = mesh.vertices.col(first), b = mesh.vertices.col(second);
      length += (b - a).norm();
      EXPECT_TRUE((a.x() == b.x() && (a.x() == low.x() || a.x() == high.x())) ||
                  (a.y() == b.y() && (a.y() == low.y() || a.y() == high.y())));
      n_corners += (a.x() == low.x() || a.x() == high.x()) && (a.y() == low.y() || a.y() == high.y());
    }
    EXPECT_NEAR(length, 2 * (high - low).sum(), 1e-13);
    EXPECT_EQ(n_corners, 4);
  }
}

TEST_P(Generators, RefuseWhatCannotBeDivided) {
  EXPECT_THROW(GetParam().make(0, 1), Error);
  EXPECT_THROW(GetParam().make(3, 0), Error);
  EXPECT_THROW(GetParam().make(1 << 15, 1 << 15), Error);
}

TEST(Rectangles, RefuseARectangleWithoutArea) {
  EXPECT_THROW(rectangles({0, 0}, {1, 0}, 2, 2), Error);
  EXPECT_THROW(rectangles({0, 0}, {1, std::nan("")}, 2, 2), Error);
  EXPECT_THROW(rectangles({1, 0}, {0, 1}, 2, 2), Error);
}

TEST(Hexagons, AreConvexAndOfTheSameAreaButHalfOnes) {
  const PolygonMesh mesh = hexagons({0, 0}, {1, 1}, 6, 5);
  int n_halves = 0, n_hexagons = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    EXPECT_FALSE(find_non_convex_corner(cell, 0.1));
    const double relative_area = signed_area(cell) * 30;
    EXPECT_NEAR(relative_area, relative_area < 0.75 ? 0.5 : 1, 1e-14);
    n_halves += relative_area < 0.75;
    n_hexagons += cell.cols() == 6;
  }
  EXPECT_EQ(n_halves, 4);
  EXPECT_EQ(n_hexagons, 6 + 2 * 5) << "those that touch no side: whole rows of 6, and of 5 between halves";
}

TEST(Hexagons, AreRegularInRowsOfTheRightHeight) {
  const PolygonMesh mesh = hexagons({0, 0}, {5, 4 * std::sqrt(3.) / 2}, 5, 4);
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    if (cell.cols() != 6) continue;
    for (Index k = 0; k < 6; ++k)
      EXPECT_NEAR((cell.col((k + 1) % 6) - cell.col(k)).norm(), 1 / std::sqrt(3.), 1e-14);
  }
}

int count_straight_corners(const PolygonMesh& mesh) {
  int n_straight = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points cell = mesh.outline(c);
    const Index n = cell.cols();
    for (Index k = 0; k < n; ++k)
      n_straight += std::abs(cross(cell.col(k) - cell.col((k + n - 1) % n),
                                   cell.col((k + 1) % n) - cell.col(k))) < 1e-14;
  }
  return n_straight;
}

TEST(HangingVertices, AreStraightCornersOfTheCellsTheyHangIn) {
  EXPECT_EQ(count_straight_corners(rectangles_of_two_sizes(low, high, 4, 3)), 3);
  EXPECT_EQ(count_straight_corners(bricks(low, high, 4, 3)), 2 * (4 + 3));
  EXPECT_EQ(count_straight_corners(rectangles(low, high, 4, 3)), 0);
}

TEST(Chevrons, AreConcaveButForTheFirstColumn) {
  const PolygonMesh mesh = chevrons(low, high, 4, 3);
  for (int c = 0; c < mesh.n_cells(); ++c)
    EXPECT_EQ(find_non_convex_corner(mesh.outline(c)).has_value(), c % 4 != 0);
  EXPECT_THROW(chevrons(low, high, 1, 3), Error);
  EXPECT_THROW(chevrons(low, high, 2, 3, 1), Error);
}

TEST(MeshBoundary, IsSelectedByPlace) {
  const PolygonMesh mesh = rectangles(low, high, 4, 3);
  const auto at_left = [](const Vec2& x) { return x.x() == low.x(); };
  EXPECT_EQ(boundary_edges(mesh, at_left).size(), 3u);
  EXPECT_EQ(boundary_vertices(mesh, at_left), (std::vector{0, 5, 10, 15}));
  EXPECT_EQ(boundary_vertices(mesh).size(), 14u);
  const auto at_two_sides = [&](const Vec2& x) { return at_left(x) || x.y() == low.y(); };
  EXPECT_EQ(boundary_edges(mesh, at_two_sides).size(), 7u);
}

TEST(Generators, RefuseCellsThatNumbersCannotTellApart) {
  EXPECT_THROW(rectangles({1, 0}, {1 + 1e-15, 1}, 10, 1), Error);
  EXPECT_THROW(rectangles({0, 1e6}, {1, 1e6 + 1e-8}, 1, 1), Error);
  EXPECT_THROW(rectangles({-1e308, 0}, {1e308, 1}, 2, 1), Error);
  EXPECT_THROW(chevrons({0, 0}, {1, 1}, 3, 2, 1 - 1.2e-16), Error);
  EXPECT_TRUE(find_defects(rectangles({1, 0}, {1 + 1e-10, 1}, 10, 1)).empty());
  EXPECT_TRUE(find_defects(chevrons({0, 0}, {1, 1}, 3, 2, 1 - 1e-6)).empty());
}

}  // namespace
