#include <polyfem/mesh/generators.hpp>

#include <polyfem/core/error.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace polyfem {
namespace {

constexpr double most_cells = 1e8;    // so that vertices can be numbered by int
constexpr double least_step = 1e-12;  // of coordinates

/// Throws unless 1/n of an interval is a number, and one that coordinates tell apart.
void require_step(double low, double high, double n) {
  const double step = (high - low) / n;
  if (!std::isfinite(step) || !(step > least_step * std::max(std::abs(low), std::abs(high)))) {
    std::ostringstream text;
    text << "from " << low << " to " << high << " in " << n
         << " steps: they are too small, or the whole too large, for numbers of 16 digits; take fewer cells, "
            "or move the rectangle to the origin";
    throw Error(text.str());
  }
}

void require_rectangle(const Vec2& low, const Vec2& high, int n_x, int n_y, int least_n_x = 1) {
  if (n_x < least_n_x || n_y < 1 || 1. * n_x * n_y > most_cells)
    throw Error("a mesh of " + std::to_string(n_x) + " x " + std::to_string(n_y) + " cells: needs " +
                std::to_string(least_n_x) + " x 1 at least, 1e8 cells at most");
  if (!low.allFinite() || !high.allFinite() || !(low.array() < high.array()).all())
    throw Error(
        "the rectangle to be divided has no area: its second corner must lie above and to the right of "
        "its first");
  require_step(low.x(), high.x(), n_x);
  require_step(low.y(), high.y(), n_y);
}

/// The k-th of n equal steps, its ends exact.
double step(double low, double high, int k, int n) {
  return k == n ? high : low + (high - low) * k / n;
}

/// Points of a grid, and the numbers of those that have been used.
class GridVertices {
 public:
  GridVertices(const Vec2& low, const Vec2& high, int n_x, int n_y) : n_x_(n_x) {
    mesh_.vertices.resize(2, Index{n_x + 1} * (n_y + 1));
    for (int j = 0; j <= n_y; ++j)
      for (int i = 0; i <= n_x; ++i)
        mesh_.vertices.col((*this)(i, j)) << step(low.x(), high.x(), i, n_x), step(low.y(), high.y(), j, n_y);
  }
  int operator()(int i, int j) const { return j * (n_x_ + 1) + i; }
  Points& vertices() { return mesh_.vertices; }
  void add_cell(std::initializer_list<std::array<int, 2>> corners) {
    corners_.clear();
    for (const auto& [i, j] : corners) corners_.push_back((*this)(i, j));
    mesh_.add_cell(corners_);
  }
  void add_cell(std::span<const int> corners) { mesh_.add_cell(corners); }

  /// The mesh without the points no cell uses.
  PolygonMesh mesh() {
    std::vector<int> number(static_cast<std::size_t>(mesh_.vertices.cols()), -1);
    for (const int v : mesh_.indices) number[static_cast<std::size_t>(v)] = 0;
    int n_used = 0;
    for (std::size_t v = 0; v < number.size(); ++v)
      if (number[v] == 0) {
        mesh_.vertices.col(n_used) = mesh_.vertices.col(static_cast<Index>(v)).eval();
        number[v] = n_used++;
      }
    mesh_.vertices.conservativeResize(2, n_used);
    for (int& v : mesh_.indices) v = number[static_cast<std::size_t>(v)];
    return std::move(mesh_);
  }

 private:
  int n_x_;
  PolygonMesh mesh_;
  std::vector<int> corners_;
};

/// Running bond on a grid of half cells. On inner lines the vertices at the middle of a cell's top rise, and
/// those at its corners sink, by `zigzag` of a row's height.
PolygonMesh running_bond(const Vec2& low, const Vec2& high, int n_x, int n_y, double zigzag) {
  require_rectangle(low, high, n_x, n_y);
  GridVertices grid(low, high, 2 * n_x, n_y);
  const double amplitude = zigzag * (high.y() - low.y()) / n_y;
  for (int j = 1; j < n_y; ++j)
    for (int i = 0; i <= 2 * n_x; ++i)
      grid.vertices()(1, grid(i, j)) += (i + j) % 2 == 0 ? amplitude : -amplitude;
  std::vector<int> corners;
  for (int j = 0; j < n_y; ++j)
    for (int left = -(j % 2); left < 2 * n_x; left += 2) {
      corners.clear();
      const int first = std::max(left, 0), last = std::min(left + 2, 2 * n_x);
      for (int i = first; i <= last; ++i)
        if (j > 0 || i != left + 1) corners.push_back(grid(i, j));
      for (int i = last; i >= first; --i)
        if (j + 1 < n_y || i != left + 1 || i == first || i == last) corners.push_back(grid(i, j + 1));
      grid.add_cell(corners);
    }
  return grid.mesh();
}

}  // namespace

PolygonMesh rectangles(const Vec2& low, const Vec2& high, int n_x, int n_y) {
  require_rectangle(low, high, n_x, n_y);
  GridVertices grid(low, high, n_x, n_y);
  for (int j = 0; j < n_y; ++j)
    for (int i = 0; i < n_x; ++i) grid.add_cell({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
  return grid.mesh();
}

PolygonMesh triangles(const Vec2& low, const Vec2& high, int n_x, int n_y, Diagonals diagonals) {
  require_rectangle(low, high, n_x, n_y);
  GridVertices grid(low, high, n_x, n_y);
  for (int j = 0; j < n_y; ++j)
    for (int i = 0; i < n_x; ++i)
      if (diagonals == Diagonals::one_way || (i + j) % 2 == 0) {
        grid.add_cell({{i, j}, {i + 1, j}, {i + 1, j + 1}});
        grid.add_cell({{i, j}, {i + 1, j + 1}, {i, j + 1}});
      } else {
        grid.add_cell({{i, j}, {i + 1, j}, {i, j + 1}});
        grid.add_cell({{i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
      }
  return grid.mesh();
}

PolygonMesh hexagons(const Vec2& low, const Vec2& high, int n_x, int n_y) {
  return running_bond(low, high, n_x, n_y, 1. / 6);
}

PolygonMesh bricks(const Vec2& low, const Vec2& high, int n_x, int n_y) {
  return running_bond(low, high, n_x, n_y, 0);
}

PolygonMesh rectangles_of_two_sizes(const Vec2& low, const Vec2& high, int n_x, int n_y) {
  require_rectangle(low, high, n_x, n_y);
  const int middle = 2 * n_x;
  GridVertices grid(low, high, 2 * middle, 2 * n_y);
  for (int j = 0; j < 2 * n_y; ++j) {
    for (int i = 0; i < middle && j % 2 == 0; i += 2) {
      std::vector<int> corners{grid(i, j), grid(i + 2, j), grid(i + 2, j + 2), grid(i, j + 2)};
      if (i + 2 == middle) corners.insert(corners.begin() + 2, grid(middle, j + 1));
      grid.add_cell(corners);
    }
    for (int i = middle; i < 2 * middle; ++i) grid.add_cell({{i, j}, {i + 1, j}, {i + 1, j + 1}, {i, j + 1}});
  }
  return grid.mesh();
}

PolygonMesh chevrons(const Vec2& low, const Vec2& high, int n_x, int n_y, double depth) {
  require_rectangle(low, high, n_x, n_y, 2);
  if (!(depth > 0 && depth < 1)) throw Error("the depth of chevrons must lie between 0 and 1");
  require_step(low.x(), high.x(), n_x / (1 - depth));  // what is left of a cell
  GridVertices grid(low, high, n_x, 2 * n_y);
  std::vector<int> corners;
  for (int j = 0; j < 2 * n_y; j += 2)
    for (int i = 0; i < n_x; ++i) {
      corners = {grid(i, j), grid(i + 1, j)};
      if (i + 1 < n_x) {
        corners.push_back(grid(i + 1, j + 1));
        grid.vertices()(0, corners.back()) += depth * (high.x() - low.x()) / n_x;
      }
      corners.insert(corners.end(), {grid(i + 1, j + 2), grid(i, j + 2)});
      if (i > 0) corners.push_back(grid(i, j + 1));
      grid.add_cell(corners);
    }
  return grid.mesh();
}

}  // namespace polyfem
