#include <polyfem/mesh/periodic_vertices.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/mesh/mesh_boundary.hpp>

#include <algorithm>

namespace polyfem {
namespace {

double distance(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double t = std::clamp((x - a).dot(edge) / edge.squaredNorm(), 0., 1.);
  return (x - a - t * edge).norm();
}

}  // namespace

std::vector<std::array<int, 2>> periodic_vertices(const PolygonMesh& mesh, const Vec2& period,
                                                  double tolerance) {
  const std::vector<std::array<int, 2>> edges = boundary_edges(mesh);
  std::vector<int> by_x = boundary_vertices(mesh);
  const std::vector<int> vertices = by_x;
  const auto x = [&](int v) -> Vec2 { return mesh.vertices.col(v); };
  std::ranges::sort(by_x, {}, [&](int v) { return x(v).x(); });
  const double near = tolerance * period.norm();
  std::vector<std::array<int, 2>> pairs;
  for (const int v : vertices) {
    const Vec2 moved = x(v) + period;
    auto w = std::ranges::lower_bound(by_x, moved.x() - near, {}, [&](int u) { return x(u).x(); });
    while (w != by_x.end() && x(*w).x() <= moved.x() + near && (x(*w) - moved).norm() > near) ++w;
    if (w != by_x.end() && x(*w).x() <= moved.x() + near) {
      pairs.push_back({v, *w});
      continue;
    }
    for (const auto& [a, b] : edges)
      if (distance(moved, x(a), x(b)) <= near)
        throw Error(mesh.vertex_name(v) + " moved by the period lies between " + mesh.vertex_name(a) +
                    " and " + mesh.vertex_name(b) + ": give both sides of a periodic cell the same vertices");
  }
  return pairs;
}

}  // namespace polyfem
