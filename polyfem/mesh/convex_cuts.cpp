#include <polyfem/mesh/convex_cuts.hpp>

#include <polyfem/geometry/predicates.hpp>
#include <polyfem/mesh/corner_turn.hpp>

#include <algorithm>
#include <cmath>

namespace polyfem {

namespace {

using Corners = std::vector<int>;

class CellCutter {
 public:
  CellCutter(const Points& vertices, double least_turn, PolygonMesh& result)
      : vertices_(vertices), least_turn_(least_turn), result_(result) {}

  void cut(const Corners& cell) {
    int worst = 0;
    for (int k = 1; k < size(cell); ++k)
      if (turn(cell, k) < turn(cell, worst)) worst = k;
    const int end = turn(cell, worst) > least_turn_ ? -1 : best_diagonal(cell, worst);
    if (end < 0) {
      result_.add_cell(cell);
      return;
    }
    const auto [first, second] = std::minmax(worst, end);
    cut(Corners(cell.begin() + first, cell.begin() + second + 1));
    Corners rest(cell.begin() + second, cell.end());
    rest.insert(rest.end(), cell.begin(), cell.begin() + first + 1);
    cut(rest);
  }

 private:
  static int size(const Corners& cell) { return static_cast<int>(cell.size()); }
  Vec2 vertex(const Corners& cell, int k) const {
    return vertices_.col(cell[static_cast<std::size_t>((k + size(cell)) % size(cell))]);
  }
  double turn(const Corners& cell, int k) const {
    return turn_sine(vertex(cell, k - 1), vertex(cell, k), vertex(cell, k + 1));
  }

  int best_diagonal(const Corners& cell, int start) const {
    int best = -1;
    double best_sine = -1;
    for (int step = 2; step + 1 < size(cell); ++step) {
      const int end = (start + step) % size(cell);
      const double sine = std::min(least_sine(cell, start, end), least_sine(cell, end, start));
      if (sine > best_sine && is_inside(cell, start, end)) {
        best_sine = sine;
        best = end;
      }
    }
    return best;
  }

  /// Of the two angles into which the corner `at` is divided by the diagonal to `end`; negative for an angle
  /// beyond half a turn.
  double least_sine(const Corners& cell, int at, int end) const {
    const Vec2 corner = vertex(cell, at);
    const Vec2 diagonal = (vertex(cell, end) - corner).normalized();
    const Vec2 out = (vertex(cell, at + 1) - corner).normalized();
    const Vec2 back = (vertex(cell, at - 1) - corner).normalized();
    return std::min(cross(out, diagonal), cross(diagonal, back));
  }

  /// Whether the diagonal leaves both its ends into the cell and meets no other edge.
  bool is_inside(const Corners& cell, int start, int end) const {
    if (!points_inward(cell, start, end) || !points_inward(cell, end, start)) return false;
    const Vec2 a = vertex(cell, start), b = vertex(cell, end);
    for (int k = 0; k < size(cell); ++k) {
      const int next = (k + 1) % size(cell);
      if (k == start || k == end || next == start || next == end) continue;
      if (segments_intersect(a, b, vertex(cell, k), vertex(cell, next))) return false;
    }
    return true;
  }
  bool points_inward(const Corners& cell, int at, int end) const {
    const Vec2 before = vertex(cell, at - 1), corner = vertex(cell, at), after = vertex(cell, at + 1);
    const bool left_of_out = orientation(corner, after, vertex(cell, end)) > 0;
    const bool left_of_in = orientation(before, corner, vertex(cell, end)) > 0;
    return orientation(before, corner, after) > 0 ? left_of_out && left_of_in : left_of_out || left_of_in;
  }

  const Points& vertices_;
  double least_turn_;
  PolygonMesh& result_;
};

}  // namespace

PolygonMesh cut_into_convex(const PolygonMesh& mesh, double least_turn) {
  PolygonMesh result;
  CellCutter cutter(mesh.vertices, least_turn, result);
  for (int c = 0; c < mesh.n_cells(); ++c) {
    const std::span<const int> cell = mesh.cell(c);
    cutter.cut(Corners(cell.begin(), cell.end()));
  }
  result.vertices = mesh.vertices;
  return result;
}

}  // namespace polyfem
