#include <polyfem/mesh/cut_grid.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/triangulation.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/sliver_cells.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace polyfem {
namespace {

constexpr double most_squares = 1e7;
/// Of the domain's area: what cells may miss of it or have twice.
constexpr double area_tolerance = 1e-9;
/// The marks of grid lines are 0 and 1, their axes.
constexpr int hole_mark = 2;

std::string ring_name(std::size_t ring) {
  return ring == 0 ? "the outline" : "hole " + std::to_string(ring);
}

/// Outline and holes.
std::vector<Points> rings_of(const GridDomain& domain) {
  std::vector<Points> rings{domain.outline};
  rings.insert(rings.end(), domain.holes.begin(), domain.holes.end());
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (const auto defect = find_defect(rings[r]))
      throw Error(ring_name(r) + " of the domain is not a simple polygon at its corner " +
                  std::to_string(defect->vertex) + ": give corners in order, each once, without crossings");
  for (std::size_t r = 1; r < rings.size(); ++r)
    for (const auto vertex : rings[r].colwise())
      if (!contains(rings[0], vertex))
        throw Error(ring_name(r) + " has a corner outside the outline of the domain: move it inside");
  for (const auto& [name, sides] : domain.sides)
    for (const DomainSide& side : sides)
      if (side.ring < 0 || static_cast<std::size_t>(side.ring) >= rings.size() || side.corner < 0 ||
          side.corner >= rings[static_cast<std::size_t>(side.ring)].cols())
        throw Error("the group \"" + name + "\" has a side at corner " + std::to_string(side.corner) +
                    " of ring " + std::to_string(side.ring) +
                    ", which the domain has not: count rings and corners from 0");
  return rings;
}

/// Lines of the grid across the domain; none along its box.
std::vector<Segment> grid_lines(const Points& outline, double spacing, const Vec2& corner) {
  const Vec2 low = outline.rowwise().minCoeff(), high = outline.rowwise().maxCoeff();
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
  return lines;
}

/// The centroid of the largest triangle of a cell.
Vec2 point_inside(const Points& outline) {
  const Triangles triangles = triangulate(outline);
  double largest = 0;
  Vec2 inside = outline.col(0);
  for (const auto triangle : triangles.colwise()) {
    const Points corners = outline(Eigen::all, triangle);
    const double area = signed_area(corners);
    if (area <= largest) continue;
    largest = area;
    inside = corners.rowwise().mean();
  }
  return inside;
}

void take_out_holes(CutCells& cut, const std::vector<Points>& holes) {
  std::erase_if(cut.cells, [&](const CutCell& cell) {
    const Vec2 inside = point_inside(cut.outline(cell));
    return std::ranges::any_of(holes, [&](const Points& hole) { return contains(hole, inside); });
  });
}

/// Puts the vertices that noding made of corners of holes back to the bit.
void restore_corners(CutCells& cut, const std::vector<Points>& holes) {
  for (const Points& hole : holes)
    for (const auto corner : hole.colwise())
      for (Vec2& vertex : cut.vertices)
        if ((vertex - corner).cwiseAbs().maxCoeff() <= cut.grid) vertex = corner;
}

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

double distance_to_side(const Points& ring, Index corner, const Vec2& x) {
  const Vec2 a = ring.col(corner), side = ring.col((corner + 1) % ring.cols()) - a;
  const double along = std::clamp((x - a).dot(side) / side.squaredNorm(), 0., 1.);
  return (x - a - along * side).norm();
}

/// Gives every boundary edge to the groups of the side it is nearest to.
void name_edges(NamedMesh& named, const GridDomain& domain, const std::vector<Points>& rings) {
  if (domain.sides.empty()) return;
  for (const auto& [name, sides] : domain.sides) named.edge_groups[name];
  for (const std::array<int, 2>& edge : boundary_edges(named.mesh)) {
    const Vec2 middle = (named.mesh.vertices.col(edge[0]) + named.mesh.vertices.col(edge[1])) / 2;
    double nearest = std::numeric_limits<double>::infinity();
    DomainSide own{};
    for (std::size_t r = 0; r < rings.size(); ++r)
      for (Index k = 0; k < rings[r].cols(); ++k)
        if (const double distance = distance_to_side(rings[r], k, middle); distance < nearest) {
          nearest = distance;
          own = {static_cast<int>(r), static_cast<int>(k)};
        }
    for (const auto& [name, sides] : domain.sides)
      if (std::ranges::any_of(sides, [&](const DomainSide& side) {
            return side.ring == own.ring && side.corner == own.corner;
          }))
        named.edge_groups[name].push_back(edge);
  }
}

}  // namespace

NamedMesh cut_grid(const GridDomain& domain, double spacing, const Vec2& corner, double smallest) {
  if (!(spacing > 0) || !std::isfinite(spacing) || !corner.allFinite())
    throw Error("the squares of a background grid need a side above 0 and a corner, not " +
                std::to_string(spacing));
  if (!(smallest >= 0 && smallest < 1))
    throw Error("the smallest cell is a share of a square in [0, 1), not " + std::to_string(smallest));
  const std::vector<Points> rings = rings_of(domain);
  std::vector<Segment> lines = grid_lines(domain.outline, spacing, corner);
  double area = std::abs(signed_area(domain.outline));
  for (const Points& hole : domain.holes) {
    for (Index k = 0; k < hole.cols(); ++k)
      lines.push_back({hole.col(k), hole.col((k + 1) % hole.cols()), hole_mark});
    area -= std::abs(signed_area(hole));
  }
  CutCells cut = cut_cells(domain.outline, lines, 0);
  if (!domain.holes.empty()) take_out_holes(cut, domain.holes);
  restore_corners(cut, domain.holes);
  double filled = 0;
  for (const CutCell& cell : cut.cells) filled += signed_area(cut.outline(cell));
  if (!(std::abs(filled - area) <= area_tolerance * std::abs(signed_area(domain.outline))))
    throw Error("the holes of the domain overlap or cross its outline: keep them apart");
  if (smallest > 0) {
    const double mean_area = area / static_cast<double>(cut.cells.size());
    merge_slivers(cut, {.area = smallest * spacing * spacing / mean_area, .angle = 0},
                  [](int mark) { return mark < hole_mark; });
  }
  NamedMesh named{.mesh = mesh_of(cut), .cell_groups = {}, .edge_groups = {}};
  name_edges(named, domain, rings);
  return named;
}

PolygonMesh cut_grid(const PointsRef& outline, double spacing, const Vec2& corner, double smallest) {
  return cut_grid(GridDomain{.outline = outline, .holes = {}, .sides = {}}, spacing, corner, smallest).mesh;
}

}  // namespace polyfem
