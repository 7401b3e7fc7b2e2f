#include <polyfem/mesh/cell_division.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

namespace polyfem {
namespace {

/// The sine of the turn from which on a vertex ends a side; where fewer than three turn so, that of any turn.
constexpr double corner_turn = 0.25, any_turn = 1e-9;
/// A vertex this near to the middle of a side, as a part of it, serves as its middle.
constexpr double near_middle = 0.2;

class Division {
 public:
  explicit Division(const PolygonMesh& mesh) : mesh_(mesh) {
    vertices_.reserve(static_cast<std::size_t>(mesh.vertices.cols()));
    for (const auto vertex : mesh.vertices.colwise()) vertices_.emplace_back(vertex);
  }

  /// Makes the middles of a cell's sides where there is no vertex.
  void halve_sides(int c) {
    const std::span<const int> cell = mesh_.cell(c);
    const std::vector<std::size_t> corners = corners_of(cell);
    for (std::size_t k = 0; k < corners.size(); ++k)
      halve(cell, corners[k], corners[(k + 1) % corners.size()]);
  }

  /// A cell with the middles that its sides have got.
  std::vector<int> with_middles(int c) const {
    const std::span<const int> cell = mesh_.cell(c);
    std::vector<int> whole;
    for (std::size_t k = 0; k < cell.size(); ++k) {
      whole.push_back(cell[k]);
      const auto middle = middles_.find(edge(cell[k], cell[(k + 1) % cell.size()]));
      if (middle != middles_.end()) whole.push_back(middle->second);
    }
    return whole;
  }

  /// The parts of a cell, one at each corner.
  std::vector<std::vector<int>> parts(int c) {
    const std::vector<int> whole = with_middles(c);
    const std::vector<std::size_t> corners = corners_of(whole);
    std::vector<std::size_t> middles;
    Vec2 centre_place = Vec2::Zero();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      middles.push_back(middle_between(whole, corners[k], corners[(k + 1) % corners.size()]));
      centre_place += position(whole[middles.back()]) / static_cast<double>(corners.size());
    }
    const auto centre = static_cast<int>(vertices_.size());
    vertices_.push_back(centre_place);
    std::vector<std::vector<int>> parts;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      std::vector<int>& part = parts.emplace_back(1, centre);
      const std::size_t last = middles[k];
      for (std::size_t at = middles[(k + corners.size() - 1) % corners.size()]; at != last;
           at = (at + 1) % whole.size())
        part.push_back(whole[at]);
      part.push_back(whole[last]);
      require_seen(c, part);
    }
    return parts;
  }

  /// The parts of an edge, in its direction.
  std::vector<std::array<int, 2>> parts(const std::array<int, 2>& whole) const {
    const auto middle = middles_.find(edge(whole[0], whole[1]));
    if (middle == middles_.end()) return {whole};
    return {{whole[0], middle->second}, {middle->second, whole[1]}};
  }

  Points vertices() const {
    Points all(2, static_cast<Index>(vertices_.size()));
    for (std::size_t v = 0; v < vertices_.size(); ++v) all.col(static_cast<Index>(v)) = vertices_[v];
    return all;
  }

 private:
  static std::array<int, 2> edge(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

  std::vector<std::size_t> corners_of(std::span<const int> cell) const {
    std::vector<std::size_t> corners = vertices_that_turn(cell, corner_turn);
    return corners.size() < 3 ? vertices_that_turn(cell, any_turn) : corners;
  }
  std::vector<std::size_t> vertices_that_turn(std::span<const int> cell, double least) const {
    std::vector<std::size_t> corners;
    const std::size_t n = cell.size();
    for (std::size_t k = 0; k < n; ++k) {
      const Vec2 before = position(cell[k]) - position(cell[(k + n - 1) % n]),
                 after = position(cell[(k + 1) % n]) - position(cell[k]);
      if (std::abs(cross(before, after)) > least * before.norm() * after.norm() || before.dot(after) < 0)
        corners.push_back(k);
    }
    return corners;
  }

  /// Of the vertices from one corner to the next, that in the middle; there is one.
  std::size_t middle_between(const std::vector<int>& whole, std::size_t first, std::size_t last) const {
    const Vec2 middle = (position(whole[first]) + position(whole[last])) / 2;
    std::size_t nearest = first;
    for (std::size_t k = first; k != last; k = (k + 1) % whole.size())
      if ((position(whole[k]) - middle).norm() < (position(whole[nearest]) - middle).norm()) nearest = k;
    return nearest;
  }

  void halve(std::span<const int> cell, std::size_t first, std::size_t last) {
    const Vec2 a = position(cell[first]), side = position(cell[last]) - a;
    const auto along = [&](int vertex) { return (position(vertex) - a).dot(side) / side.squaredNorm(); };
    for (std::size_t k = first; k != last; k = (k + 1) % cell.size())
      if (std::abs(along(cell[k]) - 0.5) < near_middle) return;
    for (std::size_t k = first; k != last; k = (k + 1) % cell.size()) {
      const int from = cell[k], to = cell[(k + 1) % cell.size()];
      const double start = along(from), end = along(to);
      if (start > 0.5 || end < 0.5) continue;
      const auto [at, is_new] = middles_.try_emplace(edge(from, to), static_cast<int>(vertices_.size()));
      if (is_new)
        vertices_.push_back(position(from) + (0.5 - start) / (end - start) * (position(to) - position(from)));
      return;
    }
  }

  void require_seen(int c, const std::vector<int>& part) const {
    const Vec2 centre = position(part[0]);
    for (std::size_t k = 1; k + 1 < part.size(); ++k)
      if (!(cross(position(part[k]) - centre, position(part[k + 1]) - centre) > 0))
        throw Error("cell " + std::to_string(c) +
                    " cannot be divided from the mean of its sides' middles, which does not see all of them: "
                    "divide concave cells into convex ones first (convex_parts)");
  }

  const Vec2& position(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }

  const PolygonMesh& mesh_;
  std::vector<Vec2> vertices_;
  std::map<std::array<int, 2>, int> middles_;  ///< of edges (lower vertex, higher one)
};

}  // namespace

NamedMesh divide_cells(const NamedMesh& named, const std::vector<char>& marked,
                       std::vector<int>* first_child) {
  const PolygonMesh& mesh = named.mesh;
  if (static_cast<int>(marked.size()) != mesh.n_cells())
    throw Error(std::to_string(marked.size()) + " marks for " + std::to_string(mesh.n_cells()) +
                " cells: give one for each");
  Division division(mesh);
  for (int c = 0; c < mesh.n_cells(); ++c)
    if (marked[static_cast<std::size_t>(c)]) division.halve_sides(c);
  NamedMesh result;
  PolygonMesh& finer = result.mesh;
  std::vector<int> first{0};
  const auto add = [&](const std::vector<int>& cell) {
    finer.indices.insert(finer.indices.end(), cell.begin(), cell.end());
    finer.offsets.push_back(static_cast<int>(finer.indices.size()));
  };
  for (int c = 0; c < mesh.n_cells(); ++c) {
    if (marked[static_cast<std::size_t>(c)])
      std::ranges::for_each(division.parts(c), add);
    else
      add(division.with_middles(c));
    first.push_back(finer.n_cells());
  }
  finer.vertices = division.vertices();
  for (const auto& [name, cells] : named.cell_groups)
    for (const int c : cells)
      for (int part = first.at(static_cast<std::size_t>(c)); part < first.at(static_cast<std::size_t>(c) + 1);
           ++part)
        result.cell_groups[name].push_back(part);
  for (const auto& [name, edges] : named.edge_groups)
    for (const auto& edge : edges)
      for (const auto& part : division.parts(edge)) result.edge_groups[name].push_back(part);
  if (first_child) *first_child = std::move(first);
  return result;
}

PolygonMesh divide_cells(const PolygonMesh& mesh, const std::vector<char>& marked,
                         std::vector<int>* first_child) {
  return divide_cells(NamedMesh{.mesh = mesh, .cell_groups = {}, .edge_groups = {}}, marked, first_child)
      .mesh;
}

}  // namespace polyfem
