#include <polyfem/core/error.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/voronoi.hpp>
#include <tests/support/domains.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <ostream>

using namespace polyfem;

namespace {

// Vertices 0 .. 11 in three rows of four, cells of the lower row 0 1 2, of the upper one 3 4 5; cell 4 has
// vertices 5 6 10 9.
const PolygonMesh sound = rectangles({0, 0}, {3, 2}, 3, 2);

void replace_vertex(PolygonMesh& mesh, int cell, int from, int to) {
  std::replace(mesh.indices.begin() + mesh.offsets[cell], mesh.indices.begin() + mesh.offsets[cell + 1], from,
               to);
}
int add_vertex(PolygonMesh& mesh, const Vec2& x) {
  mesh.vertices.conservativeResize(2, mesh.vertices.cols() + 1);
  mesh.vertices.rightCols(1) = x;
  return static_cast<int>(mesh.vertices.cols()) - 1;
}

/// A way to spoil the mesh, and what must be found first.
struct Spoilt {
  const char* name;
  std::function<void(PolygonMesh&)> spoil;
  MeshFlaw flaw;
  int cell, vertex;
  std::vector<const char*> words;
};
void PrintTo(const Spoilt& spoilt, std::ostream* out) {
  *out << spoilt.name;
}

const Spoilt spoilt_meshes[] = {
    {"offsets", [](PolygonMesh& m) { m.offsets.back() = 23; }, MeshFlaw::offsets, -1, -1, {"24", "add_cell"}},
    {"two_vertices",
     [](PolygonMesh& m) {
       m.add_cell(std::vector{3, 7});
     },
     MeshFlaw::too_few_vertices,
     6,
     3,
     {"cell 6 has 2 vertices", "three"}},
    {"no_vertices",
     [](PolygonMesh& m) { m.add_cell({}); },
     MeshFlaw::too_few_vertices,
     6,
     -1,
     {"cell 6 has 0"}},
    {"index_too_large",
     [](PolygonMesh& m) { m.indices[17] = 12; },
     MeshFlaw::index_out_of_range,
     4,
     12,
     {"cell 4 has a vertex 12", "0 to 11"}},
    {"index_negative",
     [](PolygonMesh& m) { m.indices[17] = -1; },
     MeshFlaw::index_out_of_range,
     4,
     -1,
     {"vertex -1"}},
    {"vertex_twice",
     [](PolygonMesh& m) { m.indices[17] = 5; },
     MeshFlaw::repeated_vertex,
     4,
     5,
     {"cell 4 has vertex 5 at (1, 1) twice"}},
    {"same_place_in_a_cell",
     [](PolygonMesh& m) { m.vertices.col(6) = m.vertices.col(5); },
     MeshFlaw::repeated_vertex,
     1,
     6,
     {"vertex 6 at (1, 1) and vertex 5", "cell 1", "same place"}},
    {"not_a_number",
     [](PolygonMesh& m) { m.vertices(1, 3) = std::nan(""); },
     MeshFlaw::not_finite,
     2,
     3,
     {"vertex 3 at (3, nan)", "cell 2", "finite"}},
    {"infinite",
     [](PolygonMesh& m) { m.vertices(0, 8) = -INFINITY; },
     MeshFlaw::not_finite,
     3,
     8,
     {"(-inf, 2)"}},
    {"on_a_line",
     [](PolygonMesh& m) {
       m.add_cell(std::vector{0, 1, 2});
     },
     MeshFlaw::no_area,
     6,
     0,
     {"cell 6", "no area"}},
    {"clockwise",
     [](PolygonMesh& m) { std::reverse(m.indices.begin() + 16, m.indices.begin() + 20); },
     MeshFlaw::clockwise,
     4,
     9,
     {"cell 4", "vertex 9 at (1, 2)", "clockwise", "reverse"}},
    {"crossed",
     [](PolygonMesh& m) { std::swap(m.indices[16], m.indices[17]); },
     MeshFlaw::self_intersection,
     4,
     -1,
     {"cell 4", "meets itself", "edge from vertex"}},
    {"on_each_other",
     [](PolygonMesh& m) {
       m.add_cell(std::vector{5, 6, 11});
     },
     MeshFlaw::overlap,
     4,
     5,
     {"cells 4 and 6", "vertex 5 at (1, 1) to vertex 6 at (2, 1)", "overlap"}},
    {"hanging",
     [](PolygonMesh& m) {
       const int v = add_vertex(m, {1.5, 1});
       m.indices.insert(m.indices.begin() + m.offsets[4] + 1, v);
       for (int c = 5; c <= 6; ++c) ++m.offsets[c];
     },
     MeshFlaw::hanging_vertex,
     1,
     12,
     {"vertex 12 at (1.5, 1)", "inside the edge from vertex 6 at (2, 1) to vertex 5 at (1, 1) of cell 1",
      "insert"}},
    {"crack",
     [](PolygonMesh& m) {
       replace_vertex(m, 3, 9, add_vertex(m, {1, 2 + 1e-12}));
     },
     MeshFlaw::crack,
     -1,
     12,
     {"vertex 9 and vertex 12 at (1, 2)", "same place", "make them one"}},
    {"unused",
     [](PolygonMesh& m) {
       add_vertex(m, {0.3, 0.4});
     },
     MeshFlaw::unused_vertex,
     -1,
     12,
     {"vertex 12 at (0.3, 0.4)", "no cell", "leave it out"}}};

class MeshDefects : public testing::TestWithParam<Spoilt> {};
INSTANTIATE_TEST_SUITE_P(Kinds, MeshDefects, testing::ValuesIn(spoilt_meshes),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(MeshDefects, AreNamedWithPlaceAndCure) {
  PolygonMesh mesh = sound;
  GetParam().spoil(mesh);
  const std::vector<MeshDefect> defects = find_defects(mesh);
  ASSERT_FALSE(defects.empty());
  EXPECT_EQ(defects[0].flaw, GetParam().flaw);
  if (GetParam().cell >= 0) {
    EXPECT_EQ(defects[0].cell, GetParam().cell);
  }
  if (GetParam().vertex >= 0) {
    EXPECT_EQ(defects[0].vertex, GetParam().vertex);
  }
  for (const char* words : GetParam().words)
    EXPECT_NE(defects[0].text.find(words), std::string::npos) << words << " is not in: " << defects[0].text;
}

TEST_P(MeshDefects, AreThrownTogether) {
  PolygonMesh mesh = sound;
  GetParam().spoil(mesh);
  try {
    require_valid(mesh);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(find_defects(mesh)[0].text), std::string::npos);
  }
}

TEST(FindDefects, FindsAllOfThemAtOnce) {
  PolygonMesh mesh = sound;
  add_vertex(mesh, {9, 9});
  std::reverse(mesh.indices.begin() + 16, mesh.indices.begin() + 20);  // cell 4
  mesh.indices[0] = 77;
  const std::vector<MeshDefect> defects = find_defects(mesh);
  std::vector<MeshFlaw> flaws;
  for (const MeshDefect& defect : defects) flaws.push_back(defect.flaw);
  EXPECT_EQ(flaws, (std::vector{MeshFlaw::index_out_of_range, MeshFlaw::clockwise, MeshFlaw::unused_vertex,
                                MeshFlaw::unused_vertex}));
}

TEST(FindDefects, ShowsTenAndCountsTheRest) {
  PolygonMesh mesh = sound;
  for (int k = 0; k < 25; ++k) add_vertex(mesh, {k, -1});
  try {
    require_valid(mesh);
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("25 defects"), std::string::npos);
    EXPECT_NE(text.find("and 15 more"), std::string::npos);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 11);
  }
}

TEST(FindDefects, FindsEachVertexOfEachCrackOfAMeshInPieces) {
  const PolygonMesh whole = rectangles({0, 0}, {1, 1}, 15, 15);
  PolygonMesh pieces;
  pieces.vertices.resize(2, 4 * whole.n_cells());
  for (int c = 0; c < whole.n_cells(); ++c) {
    pieces.vertices.middleCols(4 * c, 4) = whole.outline(c);
    pieces.add_cell(std::vector{4 * c, 4 * c + 1, 4 * c + 2, 4 * c + 3});
  }
  const std::vector<MeshDefect> defects = find_defects(pieces);
  // Of the pairs of pieces around a vertex: six at each of 14 x 14 inner ones, one at each of 4 x 14 on a
  // side.
  EXPECT_EQ(defects.size(), 14u * 14 * 6 + 4 * 14);
  EXPECT_TRUE(std::all_of(defects.begin(), defects.end(), [](auto& d) { return d.flaw == MeshFlaw::crack; }));
}

TEST(FindDefects, FindsHangingVerticesInEdgesOfAnyDirectionAndLength) {
  for (const double angle : {0., 0.1, 0.8, 1.5, 1.5707, 2.5, 4.}) {
    Mat2 turn;
    turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    PolygonMesh mesh =
        rectangles({0, 0}, {1, 0.01}, 100, 1);  // under one large cell with a single edge to it
    mesh.vertices.conservativeResize(2, mesh.vertices.cols() + 2);
    const int n = static_cast<int>(mesh.vertices.cols());
    mesh.vertices.rightCols(2) << 1, 0, 0.7, 0.7;
    mesh.add_cell(std::vector{101, 201, n - 2, n - 1});
    mesh.vertices = (turn * mesh.vertices).eval();
    const std::vector<MeshDefect> defects = find_defects(mesh);
    ASSERT_EQ(defects.size(), 99u) << angle;
    for (const MeshDefect& defect : defects) {
      EXPECT_EQ(defect.flaw, MeshFlaw::hanging_vertex);
      EXPECT_EQ(defect.cell, 100);
    }
  }
}

/// A mesh of the polygons given, without common vertices.
PolygonMesh mesh_of(const std::vector<std::vector<Vec2>>& polygons) {
  PolygonMesh mesh;
  for (const std::vector<Vec2>& polygon : polygons) {
    std::vector<int> corners;
    for (const Vec2& x : polygon) corners.push_back(add_vertex(mesh, x));
    mesh.add_cell(corners);
  }
  return mesh;
}

std::vector<Vec2> square(const Vec2& low, double side) {
  return {low, low + Vec2(side, 0), low + Vec2(side, side), low + Vec2(0, side)};
}

TEST(FindDefects, FindsCellsThatLieOnEachOtherUnconnected) {
  const std::vector<std::vector<std::vector<Vec2>>> overlapping = {
      {square({0, 0}, 1), square({0.5, 0.5}, 1)},    // by a quarter
      {square({0, 0}, 1), square({0.2, 0.3}, 0.4)},  // one in the other
      {square({0.2, 0.3}, 0.4), square({0, 0}, 1)},
      {square({0, 0}, 1), {{-1, 0.4}, {2, 0.4}, {2, 0.6}, {-1, 0.6}}},  // like a cross
      {square({0, 0}, 1), {{0.5, -1}, {2, 0.5}, {0.5, 2}, {-1, 0.5}}},  // turned, around the other
      {square({5, 5}, 1), square({0, 0}, 1), square({9, 0}, 1), {{0.9, 0.9}, {3, 2}, {2, 3}}}};
  for (const auto& polygons : overlapping)
    for (const double angle : {0., 0.7, 2., 4.}) {
      PolygonMesh mesh = mesh_of(polygons);
      Mat2 turn;
      turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
      mesh.vertices = (turn * mesh.vertices).eval();
      const std::vector<MeshDefect> defects = find_defects(mesh);
      ASSERT_EQ(defects.size(), 1u);
      EXPECT_EQ(defects[0].flaw, MeshFlaw::overlap);
      EXPECT_NE(defects[0].text.find("lie on each other"), std::string::npos);
    }
}

TEST(FindDefects, FindsAMeshThatWindsOverItself) {
  PolygonMesh mesh;  // a spiral of one and a half turns whose radius hardly grows
  for (int k = 0; k <= 12; ++k) {
    const Vec2 direction(std::cos(0.8 * k), std::sin(0.8 * k));
    add_vertex(mesh, (1 + 0.01 * k) * direction);
    add_vertex(mesh, (2 + 0.01 * k) * direction);
    if (k > 0) mesh.add_cell(std::vector{2 * k - 2, 2 * k - 1, 2 * k + 1, 2 * k});
  }
  const std::vector<MeshDefect> defects = find_defects(mesh);
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].flaw, MeshFlaw::overlap);
}

TEST(FindDefects, TakesPartsSideBySideInHolesAndWithACommonVertex) {
  PolygonMesh ring = rectangles({0, 0}, {3, 3}, 3, 3);  // without its middle, where a smaller square lies
  ring.indices.erase(ring.indices.begin() + 16, ring.indices.begin() + 20);
  ring.offsets.pop_back();
  const int n = static_cast<int>(ring.vertices.cols());
  for (const Vec2& x : square({1.2, 1.2}, 0.6)) add_vertex(ring, x);
  ring.add_cell(std::vector{n, n + 1, n + 2, n + 3});
  const int m = add_vertex(ring, {4, 3});
  ring.add_cell(std::vector{15, m, add_vertex(ring, {4, 4})});  // at the ring's upper right corner
  EXPECT_TRUE(find_defects(ring).empty());
  EXPECT_TRUE(
      find_defects(mesh_of({square({0, 0}, 1), square({1.5, 0.3}, 1), square({0.2, 1.1}, 1)})).empty());
}

TEST(FindDefects, TakesSmallEdgesAndThinCells) {
  EXPECT_TRUE(find_defects(mesh_of({{{0, 0}, {1, 0}, {1, 1}, {1e-12, 1}, {0, 1 - 1e-12}}})).empty());
  EXPECT_TRUE(find_defects(mesh_of({{{0, 0}, {1, 0}, {1, 9e-10}, {0, 9e-10}}})).empty());
  EXPECT_TRUE(find_defects(mesh_of({{{0, 0}, {1, 0}, {0.5, 1e-10}}})).empty());
  EXPECT_TRUE(find_defects(rectangles({0, 0}, {1, 1e-10}, 2, 2)).empty());
}

TEST(FindDefects, EndsOnEdgesBelowTheSpacingOfNumbers) {
  std::vector<Vec2> tower, needle;  // columns as wide as its mean edge have numbers above 2^53 at x = 1e9
  for (int k = 0; k < 10; ++k) tower.emplace_back(1e9 + 2.4e-7, k * 1e-15);
  for (int k = 9; k >= 0; --k) tower.emplace_back(1e9, k * 1e-15);
  EXPECT_TRUE(find_defects(mesh_of({tower})).empty());
  for (int k = 0; k < 100; ++k) needle.emplace_back(std::cos(k * M_PI / 50) * 1e-9, std::sin(k * M_PI / 50));
  for (Vec2& x : needle) x *= 1e-9;
  for (Vec2& x : tower) x.x() += 1e-6;
  EXPECT_TRUE(find_defects(mesh_of({needle, tower})).empty());
  EXPECT_NO_THROW(find_defects(mesh_of({square({-8e307, 0}, 1e307), square({1e308, 0}, 1e307)})));
}

TEST(FindDefects, FindsNothingInSoundMeshes) {
  EXPECT_TRUE(find_defects(PolygonMesh{}).empty());
  for (const Points& domain : {support::rectangle(3, 1), support::l_shape(), support::star(5)})
    EXPECT_NO_THROW(require_valid(voronoi(domain, {.n_cells = 300})));
}

}  // namespace
