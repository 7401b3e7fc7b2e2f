#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/assembly/elimination_order.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace polyfem {
namespace {

/// Parts of as many cells are not halved.
constexpr std::ptrdiff_t few_cells = 500;
/// How often cells go to the other half where that spares vertices.
constexpr int n_smoothings = 2;

/// Halves cells and finds how late each vertex has to be eliminated.
class Dissection {
 public:
  Dissection(const PolygonMesh& mesh, const VertexCells& cells_at)
      : mesh_(mesh),
        cells_at_(cells_at),
        centre_(2, mesh.n_cells()),
        cells_(static_cast<std::size_t>(mesh.n_cells())),
        part_(cells_.size(), 0),
        level_(static_cast<std::size_t>(mesh.vertices.cols()), undivided) {
    for (int c = 0; c < mesh.n_cells(); ++c) {
      Vec2 sum = Vec2::Zero();
      for (const int v : mesh.cell(c)) sum += mesh.vertices.col(v);
      sum /= static_cast<double>(mesh.cell(c).size());
      centre_.col(c) = sum.allFinite() ? sum : Vec2::Zero();
    }
    std::iota(cells_.begin(), cells_.end(), 0);
    halve(cells_, 0);
  }

  /// The group of each vertex: lower ones are eliminated first.
  std::vector<int> groups() const {
    std::vector<int> group(level_.size());
    for (std::size_t v = 0; v < group.size(); ++v)
      group[v] = level_[v] == undivided ? 0 : n_levels_ - level_[v];
    return group;
  }

 private:
  static constexpr int undivided = -1;

  /// The `level` counts how often cells were halved before.
  void halve(std::span<int> cells, int level) {
    if (std::ssize(cells) <= few_cells) return;
    n_levels_ = std::max(n_levels_, level + 1);
    Vec2 low = centre_.col(cells[0]), high = low;
    for (const int c : cells) {
      low = low.cwiseMin(centre_.col(c));
      high = high.cwiseMax(centre_.col(c));
    }
    const Index axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
    const auto half = cells.size() / 2;
    std::nth_element(
        cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(half), cells.end(),
        [&](int a, int b) { return std::pair(centre_(axis, a), a) < std::pair(centre_(axis, b), b); });
    const int low_part = ++n_parts_, high_part = ++n_parts_;
    for (std::size_t k = 0; k < cells.size(); ++k)
      part_[static_cast<std::size_t>(cells[k])] = k < half ? low_part : high_part;
    for (int round = 0; round < n_smoothings; ++round)
      for (const int c : cells) {
        int& part = part_[static_cast<std::size_t>(c)];
        if (n_vertices_spared(c) > 0) part = part == low_part ? high_part : low_part;
      }
    const auto end_of_low = std::partition(
        cells.begin(), cells.end(), [&](int c) { return part_[static_cast<std::size_t>(c)] == low_part; });
    const std::span<int> halves[] = {{cells.begin(), end_of_low}, {end_of_low, cells.end()}};
    for (const int c : halves[0])
      for (const int v : mesh_.cell(c)) separate(v, high_part, level);
    for (const std::span<int>& cells_of_half : halves)
      if (cells_of_half.size() < cells.size()) halve(cells_of_half, level + 1);
  }

  /// How many vertices fewer come between the halves when a cell goes to the other one. All cells at a vertex
  /// that is undivided are of these halves.
  int n_vertices_spared(int cell) const {
    int n = 0;
    for (const int v : mesh_.cell(cell)) {
      if (level_[static_cast<std::size_t>(v)] != undivided) continue;
      bool meets_own = false, meets_other = false;
      for (const int c : cells_at_[v]) {
        if (c == cell) continue;
        const bool is_own = part_[static_cast<std::size_t>(c)] == part_[static_cast<std::size_t>(cell)];
        (is_own ? meets_own : meets_other) = true;
      }
      n += (meets_other && !meets_own) - (meets_own && !meets_other);
    }
    return n;
  }

  /// A vertex of one half comes between both if a cell of the other half has it, too.
  void separate(int v, int other, int level) {
    int& own = level_[static_cast<std::size_t>(v)];
    if (own != undivided) return;
    for (const int c : cells_at_[v])
      if (part_[static_cast<std::size_t>(c)] == other) {
        own = level;
        return;
      }
  }

  const PolygonMesh& mesh_;
  const VertexCells& cells_at_;
  Points centre_;
  std::vector<int> cells_, part_;
  std::vector<int> level_;  ///< of vertices between halves, how often these cells had been halved before
  int n_levels_ = 0, n_parts_ = 0;
};

}  // namespace

std::vector<int> elimination_order(const PolygonMesh& mesh, const VertexCells& cells_at,
                                   std::span<const int> first, std::span<const int> neighbour) {
  return minimum_degree_order(first, neighbour, Dissection(mesh, cells_at).groups());
}

}  // namespace polyfem
