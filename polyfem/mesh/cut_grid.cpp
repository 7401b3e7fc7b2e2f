#include <polyfem/mesh/cut_grid.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/mesh/sliver_cells.hpp>

#include <cmath>
#include <string>

namespace polyfem {
namespace {

constexpr double most_squares = 1e7;

/// With the vertices that cells have, in the order in which cells first come to them.
PolygonMesh mesh_of(const CutCells& cut) {
  PolygonMesh mesh;
  std::vector<int> number(cut.vertices.size(), -1), used;
  for (const CutCell& cell : cut.cells) {
    std::vector<int> corners;
    for (const int v : cell.corners) {
      int& place = number[static_cast<std::size_t>(v)];
      if (place < 0) {
        place = static_cast<int>(used.size());
        used.push_back(v);
      }
      corners.push_back(place);
    }
    mesh.add_cell(corners);
  }
  mesh.vertices.resize(2, static_cast<Index>(used.size()));
  for (std::size_t k = 0; k < used.size(); ++k)
    mesh.vertices.col(static_cast<Index>(k)) = cut.vertices[static_cast<std::size_t>(used[k])];
  return mesh;
}

}  // namespace

PolygonMesh cut_grid(const PointsRef& domain, double spacing, const Vec2& corner, double smallest) {
  if (!(spacing > 0) || !std::isfinite(spacing) || !corner.allFinite())
    throw Error("the squares of a background grid need a side above 0 and a corner, not " +
                std::to_string(spacing));
  if (!(smallest >= 0 && smallest < 1))
    throw Error("the smallest cell is a share of a square in [0, 1), not " + std::to_string(smallest));
  const Vec2 low = domain.rowwise().minCoeff(), high = domain.rowwise().maxCoeff();
  const Vec2 first = ((low - corner) / spacing).array().floor(),
             last = ((high - corner) / spacing).array().ceil();
  if (!((last - first).prod() <= most_squares))
    throw Error("the background grid has more than 1e7 squares: choose a larger spacing than " +
                std::to_string(spacing));
  std::vector<Segment> lines;
  const Vec2 from = corner + spacing * first, to = corner + spacing * last;
  for (const int axis : {0, 1})
    for (double k = first[axis] + 1; k < last[axis]; ++k) {
      Segment line{from, to, axis};
      line.from[axis] = line.to[axis] = corner[axis] + spacing * k;
      lines.push_back(line);
    }
  CutCells cut = cut_cells(domain, lines, 0);
  if (smallest > 0) {
    const double mean_area = std::abs(signed_area(domain)) / static_cast<double>(cut.cells.size());
    merge_slivers(cut, {.area = smallest * spacing * spacing / mean_area, .angle = 0},
                  [](int) { return true; });
  }
  return mesh_of(cut);
}

}  // namespace polyfem
