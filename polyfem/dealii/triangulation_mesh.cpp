#include <polyfem/dealii/triangulation_mesh.hpp>

#include <deal.II/grid/tria.h>
#include <deal.II/grid/tria_accessor.h>
#include <deal.II/grid/tria_iterator.h>

#include <cassert>
#include <span>

namespace polyfem {
namespace {

using Triangulation = dealii::Triangulation<2>;
using Cell = Triangulation::active_cell_iterator;
using Line = Triangulation::line_iterator;

/// A corner of an outline, by deal.II's number, and the line that leads to the next one.
struct Corner {
  unsigned vertex;
  Line line;
};

/// For each corner, counter-clockwise: its number in the cell and that of the line to the next one.
std::span<const std::array<unsigned, 2>> corners_and_lines(const Cell& cell) {
  static constexpr std::array<std::array<unsigned, 2>, 3> triangle{{{0, 0}, {1, 1}, {2, 2}}};
  static constexpr std::array<std::array<unsigned, 2>, 4> quadrilateral{{{0, 2}, {1, 1}, {3, 3}, {2, 0}}};
  if (cell->n_vertices() == 3) return triangle;
  return quadrilateral;
}

double signed_area(const Cell& cell) {
  const auto order = corners_and_lines(cell);
  double twice_area = 0;
  for (std::size_t k = 2; k < order.size(); ++k) {
    const auto to_previous = cell->vertex(order[k - 1][0]) - cell->vertex(order[0][0]);
    const auto to_this = cell->vertex(order[k][0]) - cell->vertex(order[0][0]);
    twice_area += to_previous[0] * to_this[1] - to_previous[1] * to_this[0];
  }
  return twice_area / 2;
}

/// Counter-clockwise, hanging nodes included.
void find_outline(const Cell& cell, std::vector<Corner>& outline) {
  outline.clear();
  const auto order = corners_and_lines(cell);
  const std::size_t n = order.size();
  const bool clockwise = signed_area(cell) < 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t side = clockwise ? n - 1 - k : k;
    const std::size_t start = clockwise ? (side + 1) % n : side;
    const Line line = cell->line(order[side][1]);
    outline.push_back({cell->vertex_index(order[start][0]), line});
    if (line->has_children()) {  // the neighbour is refined, once at most
      assert(!line->child(0)->has_children() && !line->child(1)->has_children());
      outline.push_back({line->child(0)->vertex_index(1), line});
    }
  }
}

/// Those of active cells. deal.II calls used also what a file had besides.
std::vector<bool> vertices_of_cells(const Triangulation& triangulation) {
  std::vector<bool> used(triangulation.n_vertices());
  for (const Cell& cell : triangulation.active_cell_iterators())
    for (const unsigned k : cell->vertex_indices()) used[cell->vertex_index(k)] = true;
  return used;
}

void add_vertices(const Triangulation& triangulation, TriangulationMesh& mesh) {
  const std::vector<bool> used = vertices_of_cells(triangulation);
  mesh.mesh_vertex.assign(used.size(), -1);
  for (unsigned v = 0; v < used.size(); ++v)
    if (used[v]) {
      mesh.mesh_vertex[v] = static_cast<int>(mesh.triangulation_vertex.size());
      mesh.triangulation_vertex.push_back(v);
    }
  mesh.vertices.resize(2, static_cast<Index>(mesh.triangulation_vertex.size()));
  for (Index i = 0; i < mesh.vertices.cols(); ++i) {
    const dealii::Point<2>& x = triangulation.get_vertices()[mesh.triangulation_vertex[i]];
    mesh.vertices.col(i) << x[0], x[1];
  }
}

void add_cell(std::span<const Corner> outline, TriangulationMesh& mesh) {
  std::vector<int> corners;
  for (const Corner& corner : outline) corners.push_back(mesh.mesh_vertex[corner.vertex]);
  const int cell = mesh.n_cells(), n = static_cast<int>(corners.size());
  for (int k = 0; k < n; ++k)
    if (outline[k].line->at_boundary())
      mesh.boundary.push_back({cell, k, {corners[k], corners[(k + 1) % n]}, outline[k].line->boundary_id()});
  mesh.add_cell(corners);
}

}  // namespace

TriangulationMesh polygon_mesh(const Triangulation& triangulation) {
  TriangulationMesh mesh;
  add_vertices(triangulation, mesh);
  std::vector<Corner> outline;
  for (const Cell& cell : triangulation.active_cell_iterators()) {
    find_outline(cell, outline);
    add_cell(outline, mesh);
    mesh.material_ids.push_back(cell->material_id());
  }
  return mesh;
}

}  // namespace polyfem
