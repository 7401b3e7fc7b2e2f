#include <polyfem/mesh/weld.hpp>

#include <bit>
#include <cstdint>

namespace polyfem {

namespace {

/// Vertices in the squares of a grid eight tolerances wide; a square is found by hashing.
class VertexTable {
 public:
  VertexTable(std::size_t most_vertices, double tolerance)
      : tolerance_(tolerance), slots_(std::bit_ceil(2 * most_vertices + 2), -1) {
    vertices_.reserve(most_vertices);
  }

  int find_or_add(const Vec2& x) {
    const Vec2 low = square_of(x.array() - tolerance_), high = square_of(x.array() + tolerance_);
    for (double i = low.x(); i <= high.x(); ++i)
      for (double j = low.y(); j <= high.y(); ++j)
        if (const int found = find(Vec2(i, j), x); found >= 0) return found;
    std::size_t slot = first_slot(square_of(x));
    while (slots_[slot] >= 0) slot = next(slot);
    slots_[slot] = static_cast<int>(vertices_.size());
    vertices_.push_back(x);
    return slots_[slot];
  }

  Points points() const {
    Points points(2, static_cast<Index>(vertices_.size()));
    for (std::size_t i = 0; i < vertices_.size(); ++i) points.col(static_cast<Index>(i)) = vertices_[i];
    return points;
  }

 private:
  Vec2 square_of(const Vec2& x) const { return (x / (8 * tolerance_)).array().floor(); }
  std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  std::size_t first_slot(const Vec2& square) const {
    std::uint64_t hash = std::bit_cast<std::uint64_t>(square.x() + 0.0) * 0x9e3779b97f4a7c15u;
    hash = (hash ^ hash >> 29 ^ std::bit_cast<std::uint64_t>(square.y() + 0.0)) * 0xbf58476d1ce4e5b9u;
    return (hash ^ hash >> 32) & (slots_.size() - 1);
  }
  int find(const Vec2& square, const Vec2& x) const {
    for (std::size_t slot = first_slot(square); slots_[slot] >= 0; slot = next(slot))
      if ((vertices_[slots_[slot]] - x).norm() <= tolerance_) return slots_[slot];
    return -1;
  }

  double tolerance_;
  std::vector<int> slots_;  ///< indices of vertices, -1: empty
  std::vector<Vec2> vertices_;
};

}  // namespace

PolygonMesh weld(const Rings& rings, double tolerance) {
  VertexTable table(rings.points.size(), tolerance);
  PolygonMesh mesh;
  std::vector<int> corners;
  for (int r = 0; r < rings.n_rings(); ++r) {
    corners.clear();
    for (int k = rings.offsets[r]; k < rings.offsets[r + 1]; ++k) {
      const int vertex = table.find_or_add(rings.points[k]);
      if (corners.empty() || corners.back() != vertex) corners.push_back(vertex);
    }
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    if (corners.size() >= 3) mesh.add_cell(corners);
  }
  mesh.vertices = table.points();
  return mesh;
}

}  // namespace polyfem
