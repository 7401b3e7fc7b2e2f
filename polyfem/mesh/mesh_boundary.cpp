#include <polyfem/mesh/mesh_boundary.hpp>

#include <algorithm>

namespace polyfem {

std::vector<std::array<int, 2>> boundary_edges(const PolygonMesh& mesh, const Region& region) {
  std::vector<std::array<int, 2>> edges = boundary_edges(mesh);
  std::erase_if(edges, [&](const std::array<int, 2>& edge) {
    const Vec2 a = mesh.vertices.col(edge[0]), b = mesh.vertices.col(edge[1]);
    return !region(a) || !region(b) || !region((a + b) / 2);
  });
  return edges;
}

std::vector<int> boundary_vertices(const PolygonMesh& mesh, const Region& region) {
  std::vector<int> vertices;
  for (const auto& edge : boundary_edges(mesh))
    for (const int v : edge)
      if (region(mesh.vertices.col(v))) vertices.push_back(v);
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<int> boundary_vertices(const PolygonMesh& mesh) {
  return boundary_vertices(mesh, [](const Vec2&) { return true; });
}

}  // namespace polyfem
