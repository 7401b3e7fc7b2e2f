#include <ddacontact/detection/broad_phase.hpp>

#include <ddacontact/core/bytes_of.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// Powers of two that are told apart, from the largest extent down; all smaller ones share the last.
constexpr int n_levels = 40;
/// Cells per box, at most: bounds the memory of a grid over a sparse scene.
constexpr double max_cells_per_item = 2;

double extent_of(const Box& box) {
  return (box.high - box.low).maxCoeff();
}

}  // namespace

Box bounding_box(const PointsRef& polygon, double margin) {
  const Vec2 m = Vec2::Constant(margin);
  return {polygon.rowwise().minCoeff() - m, polygon.rowwise().maxCoeff() + m};
}

int BroadPhase::Grid::column(double x) const {
  return static_cast<int>(std::clamp((x - origin.x()) / cell, 0.0, static_cast<double>(columns - 1)));
}
int BroadPhase::Grid::row(double y) const {
  return static_cast<int>(std::clamp((y - origin.y()) / cell, 0.0, static_cast<double>(rows - 1)));
}

const std::vector<Pair>& BroadPhase::overlapping_pairs(const std::vector<Box>& boxes) {
  found_.clear();
  sort_into_grids(boxes);
  for (std::size_t g = 0; g < n_grids_; ++g) {
    find_in(grids_[g]);
    for (std::size_t coarser = g + 1; coarser < n_grids_; ++coarser) find_between(grids_[g], grids_[coarser]);
  }
  sort_pairs(static_cast<int>(boxes.size()));
  return sorted_;
}

void BroadPhase::sort_into_grids(const std::vector<Box>& boxes) {
  items_.resize(n_levels);
  for (std::vector<int>& items : items_) items.clear();
  double largest = 0;
  for (const Box& box : boxes) largest = std::max(largest, extent_of(box));
  const int top = largest > 0 ? std::ilogb(largest) : 0;
  for (int i = 0; i < static_cast<int>(boxes.size()); ++i) {
    const double extent = extent_of(boxes[i]);
    const int level = extent > 0 ? std::min(top - std::ilogb(extent), n_levels - 1) : n_levels - 1;
    items_[level].push_back(i);
  }
  n_grids_ = 0;
  for (auto items = items_.rbegin(); items != items_.rend(); ++items) {
    if (items->empty()) continue;
    if (grids_.size() == n_grids_) grids_.emplace_back();
    fill(grids_[n_grids_++], boxes, *items);
  }
}

void BroadPhase::fill(Grid& grid, const std::vector<Box>& boxes, const std::vector<int>& items) {
  Vec2 low = boxes[items.front()].low, high = low;
  grid.extent = 0;
  for (const int i : items) {
    low = low.cwiseMin(boxes[i].low);
    high = high.cwiseMax(boxes[i].low);
    grid.extent = std::max(grid.extent, extent_of(boxes[i]));
  }
  const Vec2 size = high - low;
  const double furthest = std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
  grid.extent += 8 * std::numeric_limits<double>::epsilon() * (furthest + grid.extent);
  grid.origin = low;
  grid.cell = grid.extent > 0 ? grid.extent : std::max(size.maxCoeff(), 1.0);
  const auto excess = [&] {
    const double n_cells = (size.x() / grid.cell + 1) * (size.y() / grid.cell + 1);
    return n_cells / (max_cells_per_item * static_cast<double>(items.size()) + 1);
  };
  while (excess() > 1) grid.cell *= std::max(std::sqrt(excess()), 1.01);
  grid.columns = static_cast<int>(size.x() / grid.cell) + 1;
  grid.rows = static_cast<int>(size.y() / grid.cell) + 1;

  grid.first.assign(static_cast<std::size_t>(grid.columns) * grid.rows + 1, 0);
  cells_.clear();
  for (const int i : items) {
    const int cell = grid.row(boxes[i].low.y()) * grid.columns + grid.column(boxes[i].low.x());
    cells_.push_back(cell);
    ++grid.first[cell + 1];
  }
  for (std::size_t c = 1; c < grid.first.size(); ++c) grid.first[c] += grid.first[c - 1];
  first_.assign(grid.first.begin(), grid.first.end() - 1);
  grid.boxes.resize(items.size());
  for (std::size_t k = 0; k < items.size(); ++k)
    grid.boxes[first_[cells_[k]]++] = {boxes[items[k]], items[k]};
}

void BroadPhase::find_in(const Grid& grid) {
  // Of two boxes the one in the later cell finds the other: in its own row up to itself, and in rows before.
  const int n = static_cast<int>(grid.boxes.size());
  for (int k = 0; k < n; ++k) {
    const PlacedBox& p = grid.boxes[k];
    const int from = grid.column(p.box.low.x() - grid.extent), to = grid.column(p.box.high.x()),
              here = grid.row(p.box.low.y());
    for (int row = grid.row(p.box.low.y() - grid.extent); row <= here; ++row) {
      const int last = std::min(k, grid.first[row * grid.columns + to + 1]);
      for (int other = grid.first[row * grid.columns + from]; other < last; ++other) {
        const PlacedBox& q = grid.boxes[other];
        if (touch(p.box, q.box)) found_.push_back({std::min(p.index, q.index), std::max(p.index, q.index)});
      }
    }
  }
}

void BroadPhase::find_between(const Grid& finer, const Grid& coarser) {
  for (const PlacedBox& p : finer.boxes) {
    const int from = coarser.column(p.box.low.x() - coarser.extent), to = coarser.column(p.box.high.x()),
              last_row = coarser.row(p.box.high.y());
    for (int row = coarser.row(p.box.low.y() - coarser.extent); row <= last_row; ++row) {
      const int last = coarser.first[row * coarser.columns + to + 1];
      for (int other = coarser.first[row * coarser.columns + from]; other < last; ++other) {
        const PlacedBox& q = coarser.boxes[other];
        if (touch(p.box, q.box)) found_.push_back({std::min(p.index, q.index), std::max(p.index, q.index)});
      }
    }
  }
}

/// Counted into place by their first boxes; what then stands together is sorted by the second.
void BroadPhase::sort_pairs(int n_boxes) {
  first_.assign(static_cast<std::size_t>(n_boxes) + 1, 0);
  for (const Pair& pair : found_) ++first_[pair[0] + 1];
  for (int b = 0; b < n_boxes; ++b) first_[b + 1] += first_[b];
  sorted_.resize(found_.size());
  for (const Pair& pair : found_) sorted_[first_[pair[0]]++] = pair;
  auto begin = sorted_.begin();
  for (int b = 0; b < n_boxes; ++b) {
    const auto end = sorted_.begin() + first_[b];
    if (end - begin > 1) std::sort(begin, end);
    begin = end;
  }
}

double BroadPhase::memory() const {
  double bytes = bytes_of(items_) + bytes_of(grids_) + bytes_of(cells_) + bytes_of(first_) +
                 bytes_of(found_) + bytes_of(sorted_);
  for (const std::vector<int>& items : items_) bytes += bytes_of(items);
  for (const Grid& grid : grids_) bytes += bytes_of(grid.first) + bytes_of(grid.boxes);
  return bytes;
}

std::vector<Pair> overlapping_pairs(const std::vector<Box>& boxes) {
  BroadPhase broad_phase;
  return broad_phase.overlapping_pairs(boxes);
}

}  // namespace ddacontact
