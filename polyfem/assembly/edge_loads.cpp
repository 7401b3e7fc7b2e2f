#include <polyfem/assembly/field_problem.hpp>
#include <polyfem/core/error.hpp>
#include <polyfem/quadrature/gauss_rule.hpp>

#include <algorithm>
#include <string>

namespace polyfem {
namespace {

/// Of an edge's length: what the vertex in its middle may be off.
constexpr double off_middle = 1e-8;

/// Whether every cell lists corners and middles of edges in turn, as `with_edge_midpoints` makes them.
bool is_quadratic(const PolygonMesh& mesh) {
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> nodes = mesh.cell(c);
    if (nodes.size() < 6 || nodes.size() % 2 != 0) return false;
    for (std::size_t k = 0; k < nodes.size(); k += 2) {
      const Vec2 first = mesh.vertices.col(nodes[k]), last = mesh.vertices.col(nodes[(k + 2) % nodes.size()]);
      if ((mesh.vertices.col(nodes[k + 1]) - (first + last) / 2).norm() > off_middle * (last - first).norm())
        return false;
    }
  }
  return mesh.n_cells() > 0;
}

/// The functions of an edge's two or three nodes at t in (0, 1).
template <std::size_t n>
std::array<double, n> edge_shapes(double t) {
  if constexpr (n == 2)
    return {1 - t, t};
  else
    return {(1 - t) * (1 - 2 * t), 4 * t * (1 - t), t * (2 * t - 1)};
}

}  // namespace

void FieldProblem::require_edge(int first, int second) const {
  int reversed_in = -1;
  for (const int c : cells_at_[first]) {
    const std::span<const int> corners = mesh_->cell(c);
    const auto at = std::find(corners.begin(), corners.end(), first);
    const auto next = at + 1 == corners.end() ? corners.begin() : at + 1;
    const auto previous = (at == corners.begin() ? corners.end() : at) - 1;
    if (*next == second) return;
    if (*previous == second) reversed_in = c;
  }
  const std::string edge = "the edge from " + mesh_->vertex_name(first) + " to " + mesh_->vertex_name(second);
  if (reversed_in >= 0)
    throw Error(edge + " is to get a load, but cell " + std::to_string(reversed_in) +
                " runs along it the other way: give its vertices as {" + std::to_string(second) + ", " +
                std::to_string(first) + "}, so that the normal points outwards");
  throw Error(edge +
              " is to get a load, but no cell has that edge: give pairs of vertices that follow each " +
              "other in a cell, as boundary_edges does");
}

void FieldProblem::add_edge_loads(std::span<const std::array<int, 2>> edges, const EdgeLoad& load) {
  if (!edges.empty() && is_quadratic(*mesh_))
    throw Error("a load is on the edge from vertex " + std::to_string(edges[0][0]) + " to " +
                std::to_string(edges[0][1]) +
                ", but edges of quadratic cells have three vertices: give them by quadratic_edges or "
                "quadratic_boundary_edges");
  add_loads_on(edges, load);
}

void FieldProblem::add_edge_loads(std::span<const std::array<int, 3>> edges, const EdgeLoad& load) {
  add_loads_on(edges, load);
}

template <std::size_t n>
void FieldProblem::add_loads_on(std::span<const std::array<int, n>> edges, const EdgeLoad& load) {
  if (edges.empty())
    throw Error("a load is on no edge: its region or group has none; compare it with boundary_edges(mesh)");
  const GaussRule& rule = gauss_rule(3);
  VectorXd added = VectorXd::Zero(loads_.size());
  for (const std::array<int, n>& nodes : edges) {
    for (const int v : nodes) unknown(v, 0);
    for (std::size_t k = 0; k + 1 < n; ++k) require_edge(nodes[k], nodes[k + 1]);
    const Vec2 a = mesh_->vertices.col(nodes.front()), edge = mesh_->vertices.col(nodes.back()) - a;
    const double length = edge.norm();
    const auto refuse = [&](const std::string& reason) {
      throw Error("the load on the edge from " + mesh_->vertex_name(nodes.front()) + " to " +
                  mesh_->vertex_name(nodes.back()) + " " + reason);
    };
    if (!(length > 0)) refuse("has no direction: give it two vertices at different places");
    if constexpr (n == 3)
      if ((mesh_->vertices.col(nodes[1]) - (a + edge / 2)).norm() > off_middle * length)
        refuse("is of second order, but " + mesh_->vertex_name(nodes[1]) +
               " is not in the middle: give edges as quadratic_boundary_edges does");
    for (Index q = 0; q < rule.points.size(); ++q) {
      const double t = rule.points[q];
      const VectorXd value = load(a + t * edge, Vec2(edge.y(), -edge.x()) / length);
      if (value.size() != n_components_)
        refuse("has " + std::to_string(value.size()) + " entries: give it one for each of " +
               std::to_string(n_components_) + " components");
      if (!value.allFinite()) refuse("is not finite");
      const std::array<double, n> shape = edge_shapes<n>(t);
      for (std::size_t k = 0; k < n; ++k)
        added.segment(unknown(nodes[k], 0), n_components_) += rule.weights[q] * length * shape[k] * value;
    }
  }
  loads_ += added;
}

FieldProblem::EdgeLoad pressure(double p) {
  return [p](const Vec2&, const Vec2& outward_normal) { return -p * outward_normal; };
}

}  // namespace polyfem
