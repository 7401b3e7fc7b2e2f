#include <ddacontact/block/block_mesh.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/cell_division.hpp>
#include <polyfem/mesh/generators.hpp>
#include <polyfem/mesh/vertex_moves.hpp>
#include <polyfem/mesh/voronoi.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

using polyfem::PolygonMesh;

/// Corners that turn by less, as a sine, leave no room for a grid.
constexpr double least_turn_of_quads = 0.1;

constexpr Index corners_of_quads = 4;

double edge_length(const PointsRef& outline, Index k) {
  return (outline.col((k + 1) % outline.cols()) - outline.col(k)).norm();
}

/// The nearest whole number, the lower one of two as near: what a side's cells should be does not depend on
/// the last digit of its length.
int rounded(double cells) {
  constexpr double digits = 1e-9;
  return static_cast<int>(std::ceil(cells - 0.5 - digits));
}

/// A grid of about so many quadrilaterals as square as they can be, whichever side comes first.
PolygonMesh quads(const PointsRef& outline, double cells) {
  constexpr Index last = corners_of_quads - 1;
  if (outline.cols() != corners_of_quads)
    throw Error("quads need an outline of four corners (ask for voronoi cells)");
  const double across = (edge_length(outline, 0) + edge_length(outline, 2)) / 2,
               upwards = (edge_length(outline, 1) + edge_length(outline, last)) / 2;
  const auto along = [&](double length, double other) {
    const int beside = rounded(std::sqrt(cells * other / length));
    return std::max(1, rounded(beside < 1 ? cells : std::sqrt(cells * length / other)));
  };
  const int n_x = along(across, upwards), n_y = along(upwards, across);
  return polyfem::mapped(polyfem::rectangles({0, 0}, {1, 1}, n_x, n_y), [&](const Vec2& s) -> Vec2 {
    return (1 - s.x()) * (1 - s.y()) * outline.col(0) + s.x() * (1 - s.y()) * outline.col(1) +
           s.x() * s.y() * outline.col(2) + (1 - s.x()) * s.y() * outline.col(last);
  });
}

constexpr int most_cells = 1'000'000;

PolygonMesh graded(PolygonMesh mesh, double size, const std::vector<Vec2>& contact) {
  const auto is_large = [&](int c) {
    const Points outline = mesh.outline(c);
    const double of_cell = std::sqrt(polyfem::signed_area(outline));
    double distance = inf;
    for (const Vec2& x : contact)
      distance = std::min(distance, (outline.colwise() - x).colwise().norm().minCoeff());
    return of_cell > size + distance;
  };
  for (bool any = true; any;) {
    std::vector<char> large(static_cast<std::size_t>(mesh.n_cells()));
    for (int c = 0; c < mesh.n_cells(); ++c) large[c] = is_large(c);
    any = std::ranges::count(large, 1) > 0;
    if (any) mesh = polyfem::divide_cells(mesh, large);
    if (mesh.n_cells() > most_cells) throw Error("more than a million cells (ask for a larger `at_contact`)");
  }
  return mesh;
}

/// The ring of the mesh's boundary, counter-clockwise from its vertex nearest to `start`.
std::vector<int> boundary_ring(const PolygonMesh& mesh, const Vec2& start) {
  std::vector<int> next(static_cast<std::size_t>(mesh.vertices.cols()), -1);
  int first = -1;
  const auto distance = [&](int v) { return (mesh.vertices.col(v) - start).squaredNorm(); };
  for (const auto& [from, to] : polyfem::boundary_edges(mesh)) {
    next[from] = to;
    if (first < 0 || distance(from) < distance(first)) first = from;
  }
  std::vector<int> ring;
  for (int v = first; ring.empty() || v != first; v = next[v]) ring.push_back(v);
  return ring;
}

/// Cells with the vertices of the outline that the mesh has not, the straight ones, as corners.
struct OpenMesh {
  std::vector<Vec2> vertices;
  std::vector<std::vector<int>> cells;
  std::vector<int> ring;

  explicit OpenMesh(const PolygonMesh& mesh, const Vec2& start) : ring(boundary_ring(mesh, start)) {
    for (const Vec2& x : mesh.vertices.colwise()) vertices.push_back(x);
    for (int c = 0; c < mesh.n_cells(); ++c) cells.emplace_back(mesh.cell(c).begin(), mesh.cell(c).end());
  }

  int find_on_ring(const Vec2& x) const {
    for (int v : ring)
      if (vertices[v] == x) return v;
    return -1;
  }

  void insert(const Vec2& x) {
    std::size_t best = 0;
    double least = inf;
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 a = vertices[ring[k]], edge = vertices[ring[(k + 1) % ring.size()]] - a;
      const double along = std::clamp(edge.dot(x - a) / edge.squaredNorm(), 0.0, 1.0);
      const double distance = (a + along * edge - x).norm();
      if (distance >= least) continue;
      least = distance;
      best = k;
    }
    const int a = ring[best], b = ring[(best + 1) % ring.size()], v = static_cast<int>(vertices.size());
    vertices.push_back(x);
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(best) + 1, v);
    for (std::vector<int>& cell : cells)
      for (std::size_t k = 0; k < cell.size(); ++k)
        if (cell[k] == a && cell[(k + 1) % cell.size()] == b) {
          cell.insert(cell.begin() + static_cast<std::ptrdiff_t>(k) + 1, v);
          return;
        }
  }
};

PolygonMesh cells_of(const Points& local, const MeshOptions& options, const std::vector<Vec2>& contact) {
  const double area = polyfem::signed_area(local);
  const double wanted =
      options.cell_size > 0 ? std::max(1.0, area / (options.cell_size * options.cell_size)) : options.cells;
  if (!(wanted <= most_cells))
    throw Error("more than a million cells (ask for fewer `cells` or a larger `cell_size`)");
  polyfem::VoronoiOptions how;
  how.n_cells = static_cast<int>(std::lround(wanted));
  const bool fits_quads =
      local.cols() == corners_of_quads && !polyfem::find_non_convex_corner(local, least_turn_of_quads);
  const bool in_quads = options.kind == CellKind::quads || (options.kind == CellKind::by_shape && fits_quads);
  PolygonMesh cells = in_quads ? quads(local, wanted) : polyfem::voronoi(local, how);
  if (options.at_contact > 0 && !contact.empty())
    cells = graded(std::move(cells), options.at_contact, contact);
  return cells;
}

}  // namespace

BlockMesh divide(const PointsRef& outline, const MeshOptions& options, const std::vector<Vec2>& contact) {
  const Vec2 shift = outline.rowwise().mean();
  const Points local = outline.colwise() - shift;
  std::vector<Vec2> zone;
  for (const Vec2& x : contact) zone.push_back(x - shift);
  const PolygonMesh cells = cells_of(local, options, zone);
  OpenMesh mesh(cells, local.col(0));
  for (const Vec2& x : local.colwise())
    if (mesh.find_on_ring(x) < 0) mesh.insert(x);

  // Numbers: what contacts act on, what lies inside, what follows straight edges.
  const auto at = [&](int vertex) { return mesh.vertices[vertex]; };
  BlockMesh result;
  std::vector<int> number(mesh.vertices.size(), -1), edge_of(mesh.vertices.size(), -1);
  std::vector<bool> is_corner(mesh.vertices.size(), false), used(mesh.vertices.size(), false);
  for (const Vec2& x : local.colwise()) is_corner[mesh.find_on_ring(x)] = true;
  for (const auto& cell : mesh.cells)
    for (int v : cell) used[v] = true;
  int n = 0, edge = -1;
  for (int v : mesh.ring) {
    if (is_corner[v]) ++edge;
    edge_of[v] = edge;
    if (options.edge_nodes || is_corner[v]) {
      if (is_corner[v]) result.vertex.push_back(n);
      number[v] = n++;
    }
  }
  result.n_outline = n;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (used[v] && edge_of[v] < 0) number[v] = n++;
  for (int v : mesh.ring) {
    if (number[v] >= 0) continue;
    const int start = edge_of[v], end = (start + 1) % static_cast<int>(outline.cols());
    const Vec2 along = local.col(end) - local.col(start);
    number[v] = n++;
    result.on_straight_edges.push_back(
        {number[v], start, end, along.dot(at(v) - local.col(start)) / along.squaredNorm()});
  }
  result.points.resize(2, n);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] >= 0) result.points.col(number[v]) = mesh.vertices[v] + shift;
  for (std::size_t k = 0; k < result.vertex.size(); ++k) result.points.col(result.vertex[k]) = outline.col(k);
  for (const auto& cell : mesh.cells) {
    std::vector<int>& corners = result.cells.emplace_back();
    for (int v : cell) corners.push_back(number[v]);
  }
  return result;
}

}  // namespace ddacontact
