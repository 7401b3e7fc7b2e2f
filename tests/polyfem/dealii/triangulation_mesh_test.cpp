#include <polyfem/dealii/triangulation_mesh.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <tests/polyfem/dealii/refined_triangulation.hpp>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/lac/affine_constraints.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace polyfem;

namespace {

using Triangulation = dealii::Triangulation<2>;

/// Every inner edge is one of two cells, in opposite directions, and the others are deal.II's boundary.
void expect_conforming(const TriangulationMesh& mesh) {
  std::set<std::array<int, 2>> lines;
  for (const BoundaryLine& line : mesh.boundary) {
    const std::span<const int> cell = mesh.cell(line.cell);
    EXPECT_EQ(line.vertices[0], cell[line.edge]);
    EXPECT_EQ(line.vertices[1], cell[(line.edge + 1) % cell.size()]);
    lines.insert(line.vertices);
  }
  const auto edges = boundary_edges(mesh);
  EXPECT_EQ(lines.size(), mesh.boundary.size());
  EXPECT_EQ(lines, std::set(edges.begin(), edges.end()));
}

/// Vertices of the mesh are those of the triangulation that are used, and maps there and back agree.
void expect_same_vertices(const TriangulationMesh& mesh, const Triangulation& triangulation) {
  ASSERT_EQ(mesh.vertices.cols(), triangulation.n_used_vertices());
  ASSERT_EQ(mesh.mesh_vertex.size(), triangulation.n_vertices());
  EXPECT_EQ(std::set(mesh.indices.begin(), mesh.indices.end()).size(), triangulation.n_used_vertices());
  for (Index i = 0; i < mesh.vertices.cols(); ++i) {
    const unsigned v = mesh.triangulation_vertex[i];
    EXPECT_EQ(mesh.mesh_vertex[v], i);
    EXPECT_EQ(mesh.vertices(0, i), triangulation.get_vertices()[v][0]);
    EXPECT_EQ(mesh.vertices(1, i), triangulation.get_vertices()[v][1]);
  }
  EXPECT_EQ(std::ranges::count(mesh.mesh_vertex, -1),
            triangulation.n_vertices() - triangulation.n_used_vertices());
}

int n_straight_corners(const PolygonMesh& mesh) {
  int n = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const Points outline = mesh.outline(c);
    const Index corners = outline.cols();
    for (Index k = 0; k < corners; ++k)
      n += std::abs(turn_sine(outline.col((k + corners - 1) % corners), outline.col(k),
                              outline.col((k + 1) % corners))) < 1e-12;
  }
  return n;
}

unsigned n_hanging_nodes(const Triangulation& triangulation) {
  dealii::DoFHandler<2> dof_handler(triangulation);
  dof_handler.distribute_dofs(dealii::FE_Q<2>(1));
  dealii::AffineConstraints<double> constraints;
  dealii::DoFTools::make_hanging_node_constraints(dof_handler, constraints);
  return static_cast<unsigned>(constraints.n_constraints());
}

TEST(TriangulationMesh, CellsAreTheActiveOnesInTheirOrderCounterClockwise) {
  Triangulation triangulation;
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {3, 2}, dealii::Point<2>(0, 0),
                                                    dealii::Point<2>(3, 1), true);
  for (const auto& cell : triangulation.active_cell_iterators())
    cell->set_material_id(10 + cell->active_cell_index());
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  expect_conforming(mesh);
  expect_same_vertices(mesh, triangulation);
  for (const auto& cell : triangulation.active_cell_iterators()) {
    const int c = static_cast<int>(cell->active_cell_index());
    EXPECT_EQ(mesh.material_ids[c], 10u + c);
    EXPECT_NEAR(signed_area(mesh.outline(c)), 0.5, 1e-15);
    EXPECT_NEAR(area_moments(mesh.outline(c)).centroid.x(), cell->center()[0], 1e-15);
    EXPECT_NEAR(area_moments(mesh.outline(c)).centroid.y(), cell->center()[1], 1e-15);
  }
}

TEST(TriangulationMesh, BoundaryEdgesCarryTheirIds) {
  Triangulation triangulation;  // coloured: 0 left, 1 right, 2 bottom, 3 top
  dealii::GridGenerator::subdivided_hyper_rectangle(triangulation, {3, 2}, dealii::Point<2>(0, 0),
                                                    dealii::Point<2>(3, 1), true);
  triangulation.begin_active()->set_refine_flag();
  triangulation.execute_coarsening_and_refinement();
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  const std::array<Vec2, 4> tangent{Vec2(0, -1), Vec2(0, 1), Vec2(1, 0), Vec2(-1, 0)};
  std::array<double, 4> length{};
  for (const BoundaryLine& line : mesh.boundary) {
    const Vec2 edge = mesh.vertices.col(line.vertices[1]) - mesh.vertices.col(line.vertices[0]);
    ASSERT_LT(line.boundary_id, 4u);
    EXPECT_NEAR(edge.dot(tangent[line.boundary_id]), edge.norm(), 1e-15);
    length[line.boundary_id] += edge.norm();
  }
  EXPECT_EQ(mesh.boundary.size(), 12u);
  const std::array<double, 4> expected{1, 1, 3, 3};
  for (int side = 0; side < 4; ++side) EXPECT_NEAR(length[side], expected[side], 1e-14);
}

class RefinedTriangulation : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Seeds, RefinedTriangulation, testing::Range(1, 6));

TEST_P(RefinedTriangulation, HangingNodesBecomeStraightCornersOfTheLargerCell) {
  std::mt19937 random(GetParam());
  Triangulation triangulation;
  dealii::GridGenerator::hyper_L(triangulation);
  support::refine_randomly(triangulation, 5, random);
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  expect_conforming(mesh);
  expect_same_vertices(mesh, triangulation);
  EXPECT_EQ(n_straight_corners(mesh), n_hanging_nodes(triangulation));
  EXPECT_GT(n_straight_corners(mesh), 5);
  for (const auto& cell : triangulation.active_cell_iterators())
    EXPECT_NEAR(signed_area(mesh.outline(static_cast<int>(cell->active_cell_index()))), cell->measure(),
                1e-15);
}

TEST_P(RefinedTriangulation, CellsOneSideRefinedInOneDirectionConformToo) {
  std::mt19937 random(GetParam());
  Triangulation triangulation(Triangulation::allow_anisotropic_smoothing);
  dealii::GridGenerator::subdivided_hyper_cube(triangulation, 3);
  for (int k = 0; k < 4; ++k) {
    for (const auto& cell : triangulation.active_cell_iterators())
      if (random() % 3 == 0) cell->set_refine_flag(dealii::RefinementCase<2>(1 + random() % 3));
    triangulation.execute_coarsening_and_refinement();
  }
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  expect_conforming(mesh);
  expect_same_vertices(mesh, triangulation);
  EXPECT_GT(n_straight_corners(mesh), 5);
}

TEST_P(RefinedTriangulation, CurvedCellsMeetWithoutAGap) {
  std::mt19937 random(GetParam());
  Triangulation triangulation;
  dealii::GridGenerator::hyper_shell(triangulation, dealii::Point<2>(), 1, 2, 5);
  support::refine_randomly(triangulation, 4, random);
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  expect_conforming(mesh);
  double cells = 0, inside_boundary = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) cells += signed_area(mesh.outline(c));
  for (const BoundaryLine& line : mesh.boundary)
    inside_boundary += cross(mesh.vertices.col(line.vertices[0]), mesh.vertices.col(line.vertices[1])) / 2;
  EXPECT_NEAR(cells, inside_boundary, 1e-13);
}

TEST_P(RefinedTriangulation, TrianglesTheirHangingNodesIncluded) {
  std::mt19937 random(GetParam());
  Triangulation triangulation;
  dealii::GridGenerator::subdivided_hyper_cube_with_simplices(triangulation, 3);
  support::refine_randomly(triangulation, 2, random);
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  expect_conforming(mesh);
  expect_same_vertices(mesh, triangulation);
  double area = 0;
  for (int c = 0; c < mesh.n_cells(); ++c) {
    EXPECT_GT(signed_area(mesh.outline(c)), 0);
    area += signed_area(mesh.outline(c));
  }
  EXPECT_NEAR(area, 1, 1e-14);
}

TEST(TriangulationMesh, ClockwiseCellsAreTurned) {
  const std::vector<dealii::Point<2>> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<dealii::CellData<2>> cells(2, dealii::CellData<2>(3));
  cells[0].vertices = {0, 1, 2};
  cells[1].vertices = {0, 3, 2};
  dealii::SubCellData lines;
  lines.boundary_lines.resize(1, dealii::CellData<1>(2));
  lines.boundary_lines[0].vertices = {0, 3};
  lines.boundary_lines[0].boundary_id = 7;
  Triangulation triangulation;
  triangulation.create_triangulation(points, cells, lines);
  const TriangulationMesh mesh = polygon_mesh(triangulation);
  expect_conforming(mesh);
  for (int c = 0; c < 2; ++c) EXPECT_NEAR(signed_area(mesh.outline(c)), 0.5, 1e-15);
  for (const BoundaryLine& line : mesh.boundary)
    EXPECT_EQ(line.boundary_id == 7, (line.vertices == std::array{3, 0}));
}

}  // namespace
