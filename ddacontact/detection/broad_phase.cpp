#include <ddacontact/detection/broad_phase.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

bool touch(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// A box spanning more cells than this along an axis is kept out of the grid.
constexpr int max_cells_per_box = 4;
/// Cells per box, at most: bounds the memory of a grid over a sparse scene.
constexpr double max_cells_per_item = 4;

struct Grid {
  Vec2 origin;
  double cell;
  int columns, rows;

  int column(double x) const { return std::clamp(static_cast<int>((x - origin.x()) / cell), 0, columns - 1); }
  int row(double y) const { return std::clamp(static_cast<int>((y - origin.y()) / cell), 0, rows - 1); }
};

double extent(const Box& box) {
  return (box.high - box.low).maxCoeff();
}

/// Cells a little larger than the typical box, over the bounding box of the boxes named.
Grid make_grid(const std::vector<Box>& boxes, const std::vector<int>& items, double typical_extent) {
  Box all = boxes[items.front()];
  for (int i : items) {
    all.low = all.low.cwiseMin(boxes[i].low);
    all.high = all.high.cwiseMax(boxes[i].high);
  }
  const Vec2 size = all.high - all.low;
  double cell = 1.25 * typical_extent;
  const auto excess = [&] {
    const double n_cells = (size.x() / cell + 1) * (size.y() / cell + 1);
    return n_cells / (max_cells_per_item * static_cast<double>(items.size()) + 1);
  };
  while (excess() > 1) cell *= std::max(std::sqrt(excess()), 1.01);
  return {all.low, cell, static_cast<int>(size.x() / cell) + 1, static_cast<int>(size.y() / cell) + 1};
}

}  // namespace

Box bounding_box(const PointsRef& polygon, double margin) {
  const Vec2 m = Vec2::Constant(margin);
  return {polygon.rowwise().minCoeff() - m, polygon.rowwise().maxCoeff() + m};
}

std::vector<Pair> overlapping_pairs(const std::vector<Box>& boxes) {
  const int n = static_cast<int>(boxes.size());
  std::vector<Pair> pairs;
  if (n < 2) return pairs;

  std::vector<double> extents(n);
  std::transform(boxes.begin(), boxes.end(), extents.begin(), extent);
  std::vector<double> sorted = extents;
  std::nth_element(sorted.begin(), sorted.begin() + n / 2, sorted.end());
  const double typical = sorted[n / 2];

  std::vector<int> small, large;
  for (int i = 0; i < n; ++i) (extents[i] > max_cells_per_box * typical ? large : small).push_back(i);

  for (std::size_t a = 0; a < large.size(); ++a) {
    for (std::size_t b = a + 1; b < large.size(); ++b)
      if (touch(boxes[large[a]], boxes[large[b]])) pairs.push_back({large[a], large[b]});
    for (int i : small)
      if (touch(boxes[large[a]], boxes[i])) pairs.push_back({std::min(large[a], i), std::max(large[a], i)});
  }

  if (!small.empty() && typical > 0) {
    const Grid grid = make_grid(boxes, small, typical);
    // Boxes sorted into cells by counting; a box is listed in every cell that it touches.
    std::vector<int> first(static_cast<std::size_t>(grid.columns) * grid.rows + 1, 0);
    const auto for_cells = [&](int i, const auto& visit) {
      const int c0 = grid.column(boxes[i].low.x()), c1 = grid.column(boxes[i].high.x());
      const int r0 = grid.row(boxes[i].low.y()), r1 = grid.row(boxes[i].high.y());
      for (int r = r0; r <= r1; ++r)
        for (int c = c0; c <= c1; ++c) visit(static_cast<std::size_t>(r) * grid.columns + c);
    };
    for (int i : small) for_cells(i, [&](std::size_t cell) { ++first[cell + 1]; });
    for (std::size_t c = 1; c < first.size(); ++c) first[c] += first[c - 1];
    std::vector<int> listed(first.back()), next(first.begin(), first.end() - 1);
    for (int i : small) for_cells(i, [&](std::size_t cell) { listed[next[cell]++] = i; });

    for (std::size_t cell = 0; cell + 1 < first.size(); ++cell) {
      for (int a = first[cell]; a < first[cell + 1]; ++a) {
        for (int b = a + 1; b < first[cell + 1]; ++b) {
          const Box &p = boxes[listed[a]], &q = boxes[listed[b]];
          if (!touch(p, q)) continue;
          // A pair sharing several cells is reported by the one that holds the low corner of its overlap.
          const Vec2 corner = p.low.cwiseMax(q.low);
          if (cell != static_cast<std::size_t>(grid.row(corner.y())) * grid.columns + grid.column(corner.x()))
            continue;
          pairs.push_back({listed[a], listed[b]});
        }
      }
    }
  } else {
    for (std::size_t a = 0; a < small.size(); ++a)
      for (std::size_t b = a + 1; b < small.size(); ++b)
        if (touch(boxes[small[a]], boxes[small[b]])) pairs.push_back({small[a], small[b]});
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace ddacontact
