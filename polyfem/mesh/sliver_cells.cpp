#include <polyfem/mesh/sliver_cells.hpp>

#include <polyfem/geometry/area_moments.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace polyfem {

namespace {

/// The sharpest corner, degrees.
double sharpest(const CutCells& cells, const CutCell& cell) {
  double least = 180;
  const std::size_t n = cell.corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 p = cells.vertices[cell.corners[k]], in = cells.vertices[cell.corners[(k + n - 1) % n]] - p,
               out = cells.vertices[cell.corners[(k + 1) % n]] - p;
    const double turn = cross(out, in);
    if (turn > 0) least = std::min(least, std::atan2(turn, in.dot(out)) * 180 / std::numbers::pi);
  }
  return least;
}

double area_of(const CutCells& cells, const CutCell& cell) {
  return signed_area(cells.outline(cell));
}

double mean_area(const CutCells& cells) {
  double sum = 0;
  for (const CutCell& cell : cells.cells) sum += area_of(cells, cell);
  return sum / static_cast<double>(cells.cells.size());
}

/// A cell and what lies beyond its edges.
struct Patch {
  CutCell cell;
  std::vector<int> beyond;

  std::size_t size() const { return beyond.size(); }
  /// Appends `n` edges of another one from position `begin` on.
  void append(const Patch& from, std::size_t begin, std::size_t n) {
    for (std::size_t k = begin; k < begin + n; ++k) {
      cell.corners.push_back(from.cell.corners[k % from.size()]);
      cell.marks.push_back(from.cell.marks[k % from.size()]);
      beyond.push_back(from.beyond[k % from.size()]);
    }
  }
};

/// What two cells make, the second being called `b_index` by the first; nothing when their common border is
/// not one line, or they touch elsewhere too.
std::optional<Patch> united(const Patch& a, const Patch& b, int b_index) {
  const std::size_t n = a.size(), common = std::ranges::count(a.beyond, b_index);
  std::size_t first = 0;
  while (!(a.beyond[first] == b_index && a.beyond[(first + n - 1) % n] != b_index))
    if (++first == n) return std::nullopt;
  for (std::size_t k = first; k < first + common; ++k)
    if (a.beyond[k % n] != b_index) return std::nullopt;
  const auto at = std::ranges::find(b.cell.corners, a.cell.corners[first]) - b.cell.corners.begin();
  Patch both;
  both.append(a, first + common, n - common);
  both.append(b, static_cast<std::size_t>(at), b.size() - common);
  std::vector<int> sorted = both.cell.corners;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end()) return std::nullopt;
  return both;
}

class SliverMerger {
 public:
  SliverMerger(CutCells& cells, const SliverLimits& limits, const std::function<bool(int)>& opened)
      : cells_(cells), limits_(limits), opened_(opened), least_area_(limits.area * mean_area(cells)) {
    std::vector<std::vector<int>> beyond = neighbours(cells);
    for (std::size_t c = 0; c < beyond.size(); ++c)
      patches_.push_back({std::move(cells.cells[c]), std::move(beyond[c])});
  }

  int merge(const std::vector<int>& slivers) {
    int n_merged = 0;
    for (const int sliver : slivers) n_merged += merge(sliver);
    cells_.cells.clear();
    for (Patch& patch : patches_)
      if (patch.size() > 0) cells_.cells.push_back(std::move(patch.cell));
    return n_merged;
  }

 private:
  /// Neighbours across edges that may be opened, the longest common border first.
  std::vector<int> candidates(const Patch& of) const {
    std::map<int, double> lengths;
    for (std::size_t k = 0; k < of.size(); ++k) {
      const Vec2 along =
          cells_.vertices[of.cell.corners[(k + 1) % of.size()]] - cells_.vertices[of.cell.corners[k]];
      lengths[of.beyond[k]] +=
          opened_(of.cell.marks[k]) ? along.norm() : -std::numeric_limits<double>::infinity();
    }
    std::vector<int> order;
    for (const auto& [neighbour, length] : lengths)
      if (neighbour >= 0 && length > 0) order.push_back(neighbour);
    std::ranges::stable_sort(order, [&](int a, int b) { return lengths[a] > lengths[b]; });
    return order;
  }

  bool merge(int index) {
    Patch& sliver = patches_[index];
    const bool small = area_of(cells_, sliver.cell) < least_area_;
    if (!small && sharpest(cells_, sliver.cell) >= limits_.angle) return false;  // it has grown
    for (const int into : candidates(sliver)) {
      std::optional<Patch> both = united(sliver, patches_[into], into);
      if (!both) continue;
      const double allowed = std::min(limits_.angle, sharpest(cells_, patches_[into].cell));
      if (!small && sharpest(cells_, both->cell) < allowed) continue;
      for (const int other : sliver.beyond)
        if (other >= 0) std::ranges::replace(patches_[other].beyond, index, into);
      patches_[into] = std::move(*both);
      sliver = {};
      return true;
    }
    return false;
  }

  CutCells& cells_;
  const SliverLimits& limits_;
  const std::function<bool(int)>& opened_;
  double least_area_;
  std::vector<Patch> patches_;
};

}  // namespace

std::vector<int> find_slivers(const CutCells& cells, const SliverLimits& limits) {
  const double least_area = limits.area * mean_area(cells);
  std::vector<double> areas;
  std::vector<int> slivers;
  for (const CutCell& cell : cells.cells) {
    areas.push_back(area_of(cells, cell));
    if (areas.back() < least_area || sharpest(cells, cell) < limits.angle)
      slivers.push_back(static_cast<int>(areas.size()) - 1);
  }
  std::ranges::stable_sort(slivers, [&](int a, int b) { return areas[a] < areas[b]; });
  return slivers;
}

int merge_slivers(CutCells& cells, const SliverLimits& limits, const std::function<bool(int mark)>& opened) {
  const std::vector<int> slivers = find_slivers(cells, limits);
  return SliverMerger(cells, limits, opened).merge(slivers);
}

}  // namespace polyfem
