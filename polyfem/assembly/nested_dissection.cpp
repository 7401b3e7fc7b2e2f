#include <polyfem/assembly/nested_dissection.hpp>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <tuple>

namespace polyfem {
namespace {

constexpr int cells_of_leaf = 2;  // fewer make fewer entries of the factor, see doc/decisions.md

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
std::size_t halve(std::span<CellCentre> cells) {
  const auto [left, right] =
      std::minmax_element(cells.begin(), cells.end(), [](auto& a, auto& b) { return a.x < b.x; });
  const auto [bottom, top] =
      std::minmax_element(cells.begin(), cells.end(), [](auto& a, auto& b) { return a.y < b.y; });
  const std::size_t half = cells.size() / 2;
  const auto middle = cells.begin() + static_cast<std::ptrdiff_t>(half);
  if (right->x - left->x > top->y - bottom->y)
    std::nth_element(cells.begin(), middle, cells.end(),
                     [](auto& a, auto& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); });
  else
    std::nth_element(cells.begin(), middle, cells.end(),
                     [](auto& a, auto& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
  return half;
}

/// Leaves of a complete binary tree of `height` levels of cuts: the number of each cell's.
void number_leaves(std::span<CellCentre> cells, int height, std::uint32_t leaf,
                   std::vector<std::uint32_t>& leaf_of_cell) {
  if (height == 0) {
    for (const CellCentre& centre : cells) leaf_of_cell[static_cast<std::size_t>(centre.cell)] = leaf;
    return;
  }
  const std::size_t half = halve(cells);
  number_leaves(cells.first(half), height - 1, 2 * leaf, leaf_of_cell);
  number_leaves(cells.subspan(half), height - 1, 2 * leaf + 1, leaf_of_cell);
}

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
  const std::size_t n_vertices = static_cast<std::size_t>(mesh.vertices.cols());
  std::vector<CellCentre> centres = centres_of(mesh);
  const int height = static_cast<int>(std::bit_width(centres.size() / cells_of_leaf));
  std::vector<std::uint32_t> leaf_of_cell(centres.size());
  number_leaves(centres, height, 0, leaf_of_cell);

  std::vector<std::uint32_t> lowest(n_vertices, std::numeric_limits<std::uint32_t>::max()),
      highest(n_vertices, 0);
  for (int c = 0; c < mesh.n_cells(); ++c)
    for (const int v : mesh.cell(c)) {
      lowest[v] = std::min(lowest[v], leaf_of_cell[c]);
      highest[v] = std::max(highest[v], leaf_of_cell[c]);
    }

  std::vector<int> next((std::size_t{2} << height) + 1, 0), order(n_vertices);
  const auto node = [&](std::size_t v) { return common_node(std::min(lowest[v], highest[v]), highest[v]); };
  for (std::size_t v = 0; v < n_vertices; ++v) ++next[node(v) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (std::size_t v = 0; v < n_vertices; ++v) order[next[node(v)]++] = static_cast<int>(v);
  return order;
}

}  // namespace polyfem
