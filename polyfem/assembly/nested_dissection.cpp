#include <polyfem/assembly/nested_dissection.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <tuple>

namespace polyfem {
namespace {

constexpr int n_passes = 2;
constexpr std::size_t cells_of_leaf = 512;  // more are cut: up to there minimum degree does better

struct CellCentre {
  double x, y;
  int cell;
};

std::vector<CellCentre> centres_of(const PolygonMesh& mesh) {
  std::vector<CellCentre> centres;
  centres.reserve(static_cast<std::size_t>(mesh.n_cells()));
  for (int c = 0; c < mesh.n_cells(); ++c) {
    Vec2 sum = Vec2::Zero();
    for (const int v : mesh.cell(c)) sum += mesh.vertices.col(v);
    sum /= static_cast<double>(mesh.cell(c).size());
    centres.push_back({sum.x(), sum.y(), c});
  }
  return centres;
}

/// Brings the lower half to the front. Cells of a column or a row of a regular mesh are halved as well, by
/// the other coordinate, so that the cut has one step.
void halve(std::span<CellCentre> cells) {
  const auto [left, right] =
      std::minmax_element(cells.begin(), cells.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [bottom, top] =
      std::minmax_element(cells.begin(), cells.end(), [](auto& a, auto& b) { return a.y < b.y; });
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(cells.size() / 2);
  if (right->x - left->x > top->y - bottom->y)
    std::nth_element(cells.begin(), middle, cells.end(),
                     [](auto& a, auto& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  else
    std::nth_element(cells.begin(), middle, cells.end(),
                     [](auto& a, auto& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
}

/// Divides cells into the leaves of a complete binary tree.
class Dissection {
 public:
  explicit Dissection(const PolygonMesh& mesh)
      : mesh_(mesh),
        n_cells_of_(static_cast<std::size_t>(mesh.vertices.cols())),
        n_cells_here_(n_cells_of_.size()) {
    for (const int v : mesh.indices) ++n_cells_of_[static_cast<std::size_t>(v)];
  }

  /// The leaf of each cell, below `height` levels of cuts.
  std::vector<std::uint32_t> leaves(std::span<CellCentre> cells, int height) {
    leaf_of_cell_.resize(cells.size());
    side_.resize(cells.size());
    number_leaves(cells, height, 0);
    return std::move(leaf_of_cell_);
  }

 private:
  void number_leaves(std::span<CellCentre> cells, int height, std::uint32_t leaf) {
    if (height == 0) {
      for (const CellCentre& centre : cells) leaf_of_cell_[static_cast<std::size_t>(centre.cell)] = leaf;
      return;
    }
    halve(cells);
    const std::size_t half = smooth_cut(cells, cells.size() / 2);
    number_leaves(cells.first(half), height - 1, 2 * leaf);
    number_leaves(cells.subspan(half), height - 1, 2 * leaf + 1);
  }

  /// Moves cells across the cut where that leaves fewer vertices on it; the new size of the first half.
  std::size_t smooth_cut(std::span<CellCentre> cells, std::size_t half) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const int c = cells[k].cell;
      side_[c] = k >= half;
      for (const int v : mesh_.cell(c)) ++n_cells_here_[v][side_[c]];
    }
    const auto slack = static_cast<std::ptrdiff_t>(cells.size() / 16);
    std::ptrdiff_t excess = 0;  // of the second half
    for (int pass = 0; pass < n_passes; ++pass)
      for (const CellCentre& centre : cells) {
        const int c = centre.cell, from = side_[c], step = from == 0 ? 1 : -1;
        if (gain(c) <= 0 || std::abs(excess + step) > slack) continue;
        excess += step;
        side_[c] = static_cast<char>(1 - from);
        for (const int v : mesh_.cell(c)) {
          --n_cells_here_[v][from];
          ++n_cells_here_[v][1 - from];
        }
      }
    for (const CellCentre& centre : cells)
      for (const int v : mesh_.cell(centre.cell)) n_cells_here_[v] = {};
    const auto second = std::stable_partition(
        cells.begin(), cells.end(), [&](const CellCentre& centre) { return side_[centre.cell] == 0; });
    return static_cast<std::size_t>(second - cells.begin());
  }

  /// By how many vertices the cut is shorter once the cell is on the other side.
  int gain(int c) const {
    const int from = side_[c];
    int sum = 0;
    for (const int v : mesh_.cell(c)) {
      const auto& here = n_cells_here_[v];
      if (here[0] + here[1] < n_cells_of_[v]) continue;  // on an earlier cut
      const bool is_cut = here[1 - from] > 0, will_be_cut = here[from] > 1;
      sum += is_cut - will_be_cut;
    }
    return sum;
  }

  const PolygonMesh& mesh_;
  std::vector<int> n_cells_of_;
  std::vector<std::array<int, 2>> n_cells_here_;  ///< of each vertex, on both sides of the cut being smoothed
  std::vector<char> side_;
  std::vector<std::uint32_t> leaf_of_cell_;
};

/// The number, in post-order, of the smallest tree node that holds both leaves. Up to and without leaf k
/// there are 2 k - popcount(k) nodes that end: each leaf ends itself and as many nodes as its number has
/// trailing ones.
std::uint32_t common_node(std::uint32_t leaf, std::uint32_t other) {
  const int level = std::bit_width(leaf ^ other);
  const std::uint32_t last_leaf = leaf | ((std::uint32_t{1} << level) - 1);
  return 2 * last_leaf - static_cast<std::uint32_t>(std::popcount(last_leaf)) +
         static_cast<std::uint32_t>(level);
}

}  // namespace

std::vector<int> nested_dissection(const PolygonMesh& mesh) {
  std::vector<CellCentre> centres = centres_of(mesh);
  const int height = static_cast<int>(std::bit_width(centres.size() / cells_of_leaf));
  const std::vector<std::uint32_t> leaf_of_cell = Dissection(mesh).leaves(centres, height);

  std::vector<std::array<std::uint32_t, 2>> range(static_cast<std::size_t>(mesh.vertices.cols()),
                                                  {std::numeric_limits<std::uint32_t>::max(), 0});
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c))
      range[v] = {std::min(range[v][0], leaf_of_cell[c]), std::max(range[v][1], leaf_of_cell[c])};
  std::vector<int> stage;
  stage.reserve(range.size());
  for (const auto& [lowest, highest] : range)
    stage.push_back(static_cast<int>(common_node(std::min(lowest, highest), highest)));
  return stage;
}

}  // namespace polyfem
