#include <polyfem/mesh/convex_cuts.hpp>

#include <polyfem/geometry/corner_turn.hpp>
#include <polyfem/geometry/diagonals.hpp>

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
    const auto [part, rest] = split_at(cell, worst, end);
    cut(part);
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
      const double sine = least_diagonal_sine(vertices_, cell, start, end);
      if (sine > best_sine && is_diagonal(vertices_, cell, start, end)) {
        best_sine = sine;
        best = end;
      }
    }
    return best;
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
