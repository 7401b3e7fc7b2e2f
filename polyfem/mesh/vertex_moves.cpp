#include <polyfem/mesh/vertex_moves.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>
#include <polyfem/mesh/mesh_defects.hpp>
#include <polyfem/mesh/vertex_cells.hpp>

#include <algorithm>
#include <limits>
#include <numbers>
#include <random>

namespace polyfem {
namespace {

constexpr double least_turn_kept = 1e-2;
constexpr int most_tries = 5;

bool is_convex(const PointsRef& polygon) {
  return !find_non_convex_corner(polygon, least_turn_kept);
}

bool is_valid(const PointsRef& polygon, bool convex) {
  return convex ? is_convex(polygon) : !find_defect(polygon) && signed_area(polygon) > 0;
}

double shortest_edge(const PolygonMesh& mesh, int vertex, std::span<const int> cells) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const int c : cells) {
    const std::span<const int> corners = mesh.cell(c);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int from = corners[k], to = corners[(k + 1) % corners.size()];
      if (from == vertex || to == vertex)
        shortest = std::min(shortest, (mesh.vertices.col(to) - mesh.vertices.col(from)).norm());
    }
  }
  return shortest;
}

}  // namespace

void perturb_inner_vertices(PolygonMesh& mesh, double amount, std::uint64_t seed) {
  if (!(amount >= 0 && amount <= 1)) throw Error("inner vertices are moved by 0 to 1 of their shortest edge");
  std::vector<char> is_fixed(static_cast<std::size_t>(mesh.vertices.cols()), 0),
      was_convex(static_cast<std::size_t>(mesh.n_cells()));
  for (const int v : boundary_vertices(mesh)) is_fixed[v] = 1;
  const VertexCells cells(mesh);
  for (int c = 0; c < mesh.n_cells(); ++c) was_convex[c] = is_convex(mesh.outline(c));
  std::mt19937_64 random(seed);
  const auto uniform = [&] { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; };  // in [-1, 1)

  for (int v = 0; v < static_cast<int>(is_fixed.size()); ++v) {
    if (is_fixed[v] || cells[v].empty()) continue;
    const Vec2 position = mesh.vertices.col(v);
    const double reach = amount * shortest_edge(mesh, v, cells[v]) / std::numbers::sqrt2;
    const double x = uniform(), y = uniform();
    Vec2 move = reach * Vec2(x, y);
    const auto spoils = [&] {
      return std::any_of(cells[v].begin(), cells[v].end(),
                         [&](int c) { return !is_valid(mesh.outline(c), was_convex[c]); });
    };
    mesh.vertices.col(v) += move;
    for (int n_tries = 1; spoils(); ++n_tries) {
      move = n_tries < most_tries ? Vec2(move / 2) : Vec2::Zero();
      mesh.vertices.col(v) = position + move;
      if (n_tries == most_tries) break;
    }
  }
}

PolygonMesh mapped(PolygonMesh mesh, const std::function<Vec2(const Vec2&)>& map) {
  for (Index v = 0; v < mesh.vertices.cols(); ++v) mesh.vertices.col(v) = map(mesh.vertices.col(v));
  require_valid(mesh);
  return mesh;
}

}  // namespace polyfem
