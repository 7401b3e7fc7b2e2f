#include <polyfem/mesh/edge_defects.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

namespace polyfem {

UnpairedEdges unpaired_edges(const std::vector<CellEdge>& edges, int n_vertices) {
  std::vector<int> first(static_cast<std::size_t>(n_vertices) + 1);  // edges by their lower vertex
  for (const CellEdge& edge : edges) ++first[std::min(edge.from, edge.to) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<CellEdge> sorted(edges.size());
  std::vector<int> next(first.begin(), first.end() - 1);
  for (const CellEdge& edge : edges) sorted[next[std::min(edge.from, edge.to)]++] = edge;

  UnpairedEdges result;
  for (int v = 0; v < n_vertices; ++v) {
    const auto begin = sorted.begin() + first[v], end = sorted.begin() + first[v + 1];
    std::sort(begin, end, [](const CellEdge& a, const CellEdge& b) {
      return std::tuple(a.from + a.to, a.from, a.cell) < std::tuple(b.from + b.to, b.from, b.cell);
    });
    for (auto edge = begin; edge != end;) {  // a run of the same two vertices: up first, then down
      const auto run_end = std::find_if(
          edge, end, [&](const CellEdge& other) { return other.from + other.to != edge->from + edge->to; });
      const auto down =
          std::find_if(edge, run_end, [&](const CellEdge& other) { return other.from != edge->from; });
      if (down == run_end) result.single.push_back(*edge);
      for (auto other = edge + 1; other < run_end; ++other)
        if (other->from == (other - 1)->from) result.overlaps.push_back({*(other - 1), other->cell});
      edge = run_end;
    }
  }
  return result;
}

std::string description(const EdgeOverlap& overlap, const PolygonMesh& mesh) {
  const CellEdge& edge = overlap.edge;
  return "cells " + std::to_string(edge.cell) + " and " + std::to_string(overlap.other_cell) +
         " lie on the same side of the edge from " + mesh.vertex_name(edge.from) + " to " +
         mesh.vertex_name(edge.to) + ": they overlap; correct the vertices of one";
}

namespace {

constexpr double same_place = 1e-9;  // of an edge's length

/// Vertices in columns as wide as edges are long, in each from the bottom.
class VertexColumns {
 public:
  VertexColumns(const Points& vertices, const std::vector<CellEdge>& edges) {
    double length = 0, right = vertices(0, edges[0].from);
    left_ = right;
    for (const CellEdge& edge : edges) {
      length += (vertices.col(edge.to) - vertices.col(edge.from)).norm();
      left_ = std::min({left_, vertices(0, edge.from), vertices(0, edge.to)});
      right = std::max({right, vertices(0, edge.from), vertices(0, edge.to)});
    }
    width_ = std::max({length / static_cast<double>(edges.size()), (right - left_) / most_columns,
                       std::numeric_limits<double>::min()});
    for (const CellEdge& edge : edges)
      for (const int v : {edge.from, edge.to})
        positions_.push_back({column_of(vertices(0, v)), vertices(1, v), v});
    std::sort(positions_.begin(), positions_.end());
    positions_.erase(std::unique(positions_.begin(), positions_.end()), positions_.end());
  }

  /// Calls visit(vertex) for all vertices near the segment ab, and some that are not.
  template <class Visit>
  void visit_near(const Vec2& a, const Vec2& b, double distance, Visit visit) const {
    const Vec2 &left = a.x() < b.x() ? a : b, &right = a.x() < b.x() ? b : a;
    const double slope = (right.y() - left.y()) / (right.x() - left.x());
    const double last = column_of(right.x() + distance);
    for (double column = column_of(left.x() - distance); column <= last; ++column) {
      double low = std::min(a.y(), b.y()), high = std::max(a.y(), b.y());
      if (std::abs(slope) < 1) {  // else the segment is in no more than a few columns for its height
        const double from = left.y() + slope * (left_ + column * width_ - left.x());
        const double to = from + slope * width_;
        low = std::max(low, std::min(from, to) - width_ / 4);
        high = std::min(high, std::max(from, to) + width_ / 4);
      }
      for (auto position =
               std::lower_bound(positions_.begin(), positions_.end(), Place{column, low - distance, -1});
           position != positions_.end() && position->column == column && position->y <= high + distance;
           ++position)
        visit(position->vertex);
    }
  }

 private:
  struct Place {
    double column, y;
    int vertex;
    auto operator<=>(const Place&) const = default;
  };
  /// 0 also where lengths are too large for a number.
  double column_of(double x) const { return std::floor(std::max(0., (x - left_) / width_)); }

  static constexpr double most_columns = 0x1p40;  // can be counted in double, with room for round-off
  double left_, width_;
  std::vector<Place> positions_;
};

}  // namespace

std::vector<TouchingVertex> touching_vertices(const Points& vertices, const std::vector<CellEdge>& edges,
                                              const VectorXd& size) {
  std::vector<TouchingVertex> touching;
  if (edges.empty()) return touching;
  const VertexColumns columns(vertices, edges);
  for (const CellEdge& edge : edges) {
    const Vec2 a = vertices.col(edge.from), b = vertices.col(edge.to), along = b - a;
    const double length = along.norm();
    columns.visit_near(a, b, same_place * length, [&](int v) {
      if (v == edge.from || v == edge.to) return;
      const Vec2 x = vertices.col(v);
      const double tolerance = same_place * std::min(length, size[v]);
      const double t = std::clamp((x - a).dot(along) / along.squaredNorm(), 0., 1.);
      if (!((x - a - t * along).norm() <= tolerance)) return;
      const int end = (x - a).norm() <= tolerance ? edge.from : (x - b).norm() <= tolerance ? edge.to : -1;
      touching.push_back({v, edge, end});
    });
  }
  return touching;
}

}  // namespace polyfem
