#include <tests/performance/work_precision/meshes.hpp>

#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <array>
#include <cmath>

using namespace polyfem;

namespace work_precision {
namespace {

PolygonMesh cut_along_shorter_diagonals(const PolygonMesh& quadrilaterals) {
  PolygonMesh mesh;
  mesh.vertices = quadrilaterals.vertices;
  const auto length = [&](int a, int b) { return (mesh.vertices.col(a) - mesh.vertices.col(b)).norm(); };
  for (int c = 0; c < quadrilaterals.n_cells(); ++c) {
    const auto v = quadrilaterals.cell(c);
    const std::size_t first = length(v[0], v[2]) <= length(v[1], v[3]) ? 0 : 1;
    const auto corner = [&](std::size_t k) { return v[(first + k) % 4]; };
    mesh.add_cell(std::array{corner(0), corner(1), corner(2)});
    mesh.add_cell(std::array{corner(0), corner(2), corner(3)});
  }
  return mesh;
}

}  // namespace

PolygonMesh voronoi_mesh(const Problem& problem, int n_cells) {
  Points rectangle(2, 4);
  rectangle << problem.low.x(), problem.high.x(), problem.high.x(), problem.low.x(),  //
      problem.low.y(), problem.low.y(), problem.high.y(), problem.high.y();
  return mapped(voronoi(rectangle, {.n_cells = n_cells}), problem.map);
}

PolygonMesh make_mesh(const Problem& problem, Cells cells, int n_rows) {
  const Vec2 size = problem.high - problem.low;
  const int n_columns = static_cast<int>(std::lround(n_rows * size.x() / size.y()));
  const auto mapped_to_body = [&](PolygonMesh mesh) { return mapped(std::move(mesh), problem.map); };
  if (cells == Cells::voronoi) return voronoi_mesh(problem, n_rows * n_columns);
  if (cells == Cells::hexagons) {
    const int n_rows_of_hexagons = static_cast<int>(std::lround(n_rows * std::sqrt(2 / std::sqrt(3))));
    return mapped_to_body(
        hexagons(problem.low, problem.high, n_rows * n_columns / n_rows_of_hexagons, n_rows_of_hexagons));
  }
  PolygonMesh quadrilaterals = rectangles(problem.low, problem.high, n_columns, n_rows);
  if (problem.perturbation > 0) perturb_inner_vertices(quadrilaterals, problem.perturbation);
  quadrilaterals = mapped_to_body(std::move(quadrilaterals));
  return cells == Cells::triangles ? cut_along_shorter_diagonals(quadrilaterals) : quadrilaterals;
}

}  // namespace work_precision
