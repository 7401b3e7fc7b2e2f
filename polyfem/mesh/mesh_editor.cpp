#include <polyfem/mesh/mesh_editor.hpp>

#include <polyfem/geometry/corner_turn.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace polyfem {

MeshEditor::MeshEditor(const PolygonMesh& mesh, std::vector<BoundaryPosition> positions, const Points& domain)
    : vertices_(mesh.vertices),
      domain_(domain),
      positions_(std::move(positions)),
      cells_of_(vertices_.cols()) {
  cells_.reserve(mesh.n_cells());
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> corners = mesh.cell(c);
    cells_.emplace_back(corners.begin(), corners.end());
    for (const int v : corners) cells_of_[v].push_back(c);
  }
}

double MeshEditor::turn(int c) const {
  const std::vector<int>& corners = cells_[c];
  return least_turn(static_cast<int>(corners.size()), [&](int k) -> Vec2 { return vertex(corners[k]); });
}

double MeshEditor::least_turn_around(int v) const {
  double least = std::numeric_limits<double>::infinity();
  for (const int c : cells_of_[v]) least = std::min(least, turn(c));
  return least;
}

std::vector<int> MeshEditor::neighbours(int v) const {
  std::vector<int> result;
  for (const int c : cells_of_[v]) {
    const std::vector<int>& corners = cells_[c];
    const std::size_t n = corners.size();
    const std::size_t k = std::find(corners.begin(), corners.end(), v) - corners.begin();
    result.push_back(corners[(k + 1) % n]);
    result.push_back(corners[(k + n - 1) % n]);
  }
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

std::vector<Vec2> MeshEditor::merged_positions(int u, int v) const {
  const BoundaryPosition &p = positions_[u], &q = positions_[v];
  if (p.inside() && q.inside()) return {(vertex(u) + vertex(v)) / 2, vertex(u), vertex(v)};
  if (p.inside()) return {vertex(v)};
  if (q.inside()) return {vertex(u)};
  if (!common_edge(p, q, static_cast<int>(domain_.cols()))) return {};
  if (p.corner >= 0 && q.corner >= 0) return {};
  if (p.corner >= 0) return {vertex(u)};
  if (q.corner >= 0) return {vertex(v)};
  return {(vertex(u) + vertex(v)) / 2, vertex(u), vertex(v)};
}

std::vector<int> MeshEditor::cells_around(int u, int v) const {
  std::vector<int> result;
  std::set_union(cells_of_[u].begin(), cells_of_[u].end(), cells_of_[v].begin(), cells_of_[v].end(),
                 std::back_inserter(result));
  return result;
}

/// The corners of cell c with u in the place of v, and no corner twice.
std::vector<int> MeshEditor::merged_cell(int c, int u, int v) const {
  std::vector<int> corners = cells_[c];
  std::replace(corners.begin(), corners.end(), v, u);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  if (corners.front() == corners.back()) corners.pop_back();
  return corners;
}

bool MeshEditor::collapse(int u, int v, double wanted_turn, bool may_vanish) {
  const std::vector<int> around = cells_around(u, v);
  double before = std::numeric_limits<double>::infinity();
  std::vector<std::vector<int>> merged;
  for (const int c : around) {
    before = std::min(before, turn(c));
    merged.push_back(merged_cell(c, u, v));
    if (merged.back().size() < 3 && !may_vanish) return false;
  }

  double best = -1;
  Vec2 best_position = vertex(u);
  for (const Vec2& position : merged_positions(u, v)) {
    double after = std::numeric_limits<double>::infinity();
    for (const std::vector<int>& corners : merged) {
      const auto moved = [&](int k) -> Vec2 { return corners[k] == u ? position : vertex(corners[k]); };
      if (corners.size() >= 3) after = std::min(after, least_turn(static_cast<int>(corners.size()), moved));
    }
    if (after > best) {
      best = after;
      best_position = position;
    }
  }
  if (best <= 0 || best < std::min(wanted_turn, before)) return false;

  vertices_.col(u) = best_position;
  const BoundaryPosition &p = positions_[u], &q = positions_[v];
  if (p.inside() || q.corner >= 0) positions_[u] = q;
  cells_of_[v].clear();
  cells_of_[u].clear();
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (merged[i].size() >= 3) {
      cells_of_[u].push_back(around[i]);
    } else {
      const int other = merged[i].front() == u ? merged[i].back() : merged[i].front();
      std::erase(cells_of_[other], around[i]);
      merged[i].clear();
      ++n_vanished_;
    }
    cells_[around[i]] = std::move(merged[i]);
  }
  return true;
}

bool MeshEditor::move(int v, const Vec2& target) {
  const BoundaryPosition& position = positions_[v];
  if (position.corner >= 0) return false;
  const Vec2 old = vertex(v);
  Vec2 step = target - old;
  if (position.edge >= 0) {
    const Vec2 along =
        (domain_.col((position.edge + 1) % domain_.cols()) - domain_.col(position.edge)).normalized();
    step = along.dot(step) * along;
  }
  const double before = least_turn_around(v);
  vertices_.col(v) = old + step;
  if (least_turn_around(v) > before) return true;
  vertices_.col(v) = old;
  return false;
}

PolygonMesh MeshEditor::mesh() const {
  PolygonMesh mesh;
  mesh.vertices = vertices_;
  for (const std::vector<int>& corners : cells_)
    if (!corners.empty()) mesh.add_cell(corners);
  return mesh;
}

}  // namespace polyfem
