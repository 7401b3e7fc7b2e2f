#include <polyfem/geometry/convex_parts.hpp>
#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/diagonals.hpp>
#include <polyfem/geometry/outline_cleaning.hpp>
#include <polyfem/geometry/predicates.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace polyfem {
namespace {

using Corners = std::vector<int>;

/// Sine of the angle below which what a cut leaves is a sliver.
constexpr double sliver = 0.05;

class Cutter {
 public:
  Cutter(const PointsRef& polygon, double least_turn) : polygon_(polygon), least_turn_(least_turn) {}

  std::vector<Corners> cut() {
    Corners all(static_cast<std::size_t>(polygon_.cols()));
    std::iota(all.begin(), all.end(), 0);
    find_diagonals(all);
    std::vector<Corners> to_do{all};
    while (!to_do.empty()) {
      const Corners part = std::move(to_do.back());
      to_do.pop_back();
      const auto [start, end] = best_cut(part);
      if (start < 0) {
        parts_.push_back(part);
        continue;
      }
      cuts_.emplace_back(least_diagonal_sine(polygon_, part, start, end), part[start], part[end]);
      auto [first, second] = split_at(part, start, end);
      to_do.push_back(std::move(second));
      to_do.push_back(std::move(first));
    }
    take_cuts_back();
    for (Corners& part : parts_) leave_straight_corners_out(part);
    return parts_;
  }

 private:
  static int size(const Corners& part) { return static_cast<int>(part.size()); }

  /// Whether a corner between two others is convex, or straight to within `least_turn`.
  bool turns_left(int before, int corner, int after) const {
    const Vec2 a = polygon_.col(before), b = polygon_.col(corner), c = polygon_.col(after);
    return orientation(a, b, c) >= 0 || turn_sine(a, b, c) >= -least_turn_;
  }
  bool turns_left(const Corners& part, int k) const {
    const int n = size(part);
    return turns_left(part[(k + n - 1) % n], part[k], part[(k + 1) % n]);
  }

  /// Those at each reflex corner. A diagonal of the polygon between two corners of a part is one of the part.
  void find_diagonals(const Corners& all) {
    const int n = size(all);
    for (int k = 0; k < n; ++k) {
      if (turns_left(all, k)) continue;
      Corners& ends = diagonals_[k];
      for (int step = 2; step + 1 < n; ++step)
        if (is_diagonal(polygon_, all, k, (k + step) % n)) ends.push_back((k + step) % n);
    }
  }

  /// Of the two ends of a diagonal, how many it makes convex that are not so without it.
  int n_mended(const Corners& part, int start, int end) const {
    const int n = size(part);
    int mended = 0;
    for (const auto& [at, other] : {std::pair(start, end), std::pair(end, start)}) {
      if (turns_left(part, at)) continue;
      if (turns_left(part[(at + n - 1) % n], part[at], part[other]) &&
          turns_left(part[other], part[at], part[(at + 1) % n]))
        ++mended;
    }
    return mended;
  }

  /// By indices into `part`; -1 where it is convex.
  std::pair<int, int> best_cut(const Corners& part) const {
    std::map<int, int> place_of;
    for (int k = 0; k < size(part); ++k) place_of[part[k]] = k;
    std::tuple<bool, int, double> best{false, -1, 0};
    std::pair<int, int> cut{-1, -1};
    for (int k = 0; k < size(part); ++k) {
      if (turns_left(part, k)) continue;
      for (const int target : diagonals_.at(part[k])) {
        const auto found = place_of.find(target);
        if (found == place_of.end() || !is_diagonal_of(part, k, found->second)) continue;
        const double sine = least_diagonal_sine(polygon_, part, k, found->second);
        const std::tuple<bool, int, double> quality{sine >= sliver, n_mended(part, k, found->second), sine};
        if (cut.first >= 0 && quality <= best) continue;
        best = quality;
        cut = {k, found->second};
      }
    }
    return cut;
  }
  /// Edges of the part are diagonals of the polygon where it was cut.
  static bool is_diagonal_of(const Corners& part, int start, int end) {
    const int apart = std::abs(start - end);
    return apart > 1 && apart < size(part) - 1;
  }

  void take_cuts_back() {
    std::sort(cuts_.begin(), cuts_.end());
    for (const auto& [sine, a, b] : cuts_) take_back(a, b);
  }

  void take_back(int a, int b) {
    const std::size_t one = part_with_edge(a, b), other = part_with_edge(b, a);
    Corners left = from(parts_[one], b), right = from(parts_[other], a);  // b ... a and a ... b
    Corners merged = left;
    merged.insert(merged.end(), right.begin() + 1, right.end() - 1);
    const int at_a = size(left) - 1;
    if (!turns_left(merged, 0) || !turns_left(merged, at_a)) return;
    parts_[one] = std::move(merged);
    parts_.erase(parts_.begin() + static_cast<std::ptrdiff_t>(other));
  }
  std::size_t part_with_edge(int from_corner, int to_corner) const {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const Corners& part = parts_[p];
      for (std::size_t k = 0; k < part.size(); ++k)
        if (part[k] == from_corner && part[(k + 1) % part.size()] == to_corner) return p;
    }
    return parts_.size();
  }
  /// The corners in their order from one of them on.
  static Corners from(Corners part, int corner) {
    std::rotate(part.begin(), std::find(part.begin(), part.end(), corner), part.end());
    return part;
  }

  void leave_straight_corners_out(Corners& part) const {
    Points corners(2, size(part));
    for (int k = 0; k < size(part); ++k) corners.col(k) = polygon_.col(part[k]);
    Corners kept;
    for (const std::vector<int>& sources : drop_straight_vertices(corners, least_turn_).sources)
      kept.push_back(part[sources.front()]);
    part = std::move(kept);
  }

  PointsRef polygon_;
  double least_turn_;
  std::map<int, Corners> diagonals_;  ///< of each reflex corner
  std::vector<Corners> parts_;
  std::vector<std::tuple<double, int, int>> cuts_;  ///< least sine of the angles, ends
};

}  // namespace

std::vector<std::vector<int>> convex_parts(const PointsRef& polygon, double least_turn) {
  return Cutter(polygon, least_turn).cut();
}

}  // namespace polyfem
