#include <polyfem/mesh/mesh_defects.hpp>

#include <polyfem/core/error.hpp>
#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/outline_overlap.hpp>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace polyfem {
namespace {

constexpr std::size_t most_shown = 10;

/// Whether a polygon is strictly convex beyond round-off and counter-clockwise: most cells are, and need no
/// closer look. All corners turn left, and the direction of its edges passes the horizontal twice: it turns
/// once.
bool is_clearly_convex(const PointsRef& polygon) {
  const Index n = polygon.cols();
  int n_passes = 0;
  Vec2 in = polygon.col(0) - polygon.col(n - 1);
  for (Index k = 0; k < n; ++k) {
    const Vec2 out = polygon.col(k + 1 < n ? k + 1 : 0) - polygon.col(k);
    if (!(cross(in, out) > 1e-9 * in.norm() * out.norm())) return false;
    n_passes += (in.y() > 0) != (out.y() > 0);
    in = out;
  }
  return n_passes == 2;
}

/// Collects what is wrong with a mesh.
class Inspection {
 public:
  explicit Inspection(const PolygonMesh& mesh) : mesh_(mesh) {
    if (!offsets_fit()) return;
    for (int c = 0; c < mesh.n_cells(); ++c)
      if (has_vertices(c) && has_places(c)) inspect_shape(c);
    inspect_edges();
    look_for_unused_vertices();
    std::stable_sort(defects.begin(), defects.end(),
                     [](const MeshDefect& a, const MeshDefect& b) { return a.flaw < b.flaw; });
  }

  std::vector<MeshDefect> defects;

 private:
  template <class... Words>
  void report(MeshFlaw flaw, int cell, int vertex, const Words&... words) {
    std::ostringstream text;
    (text << ... << words);
    defects.push_back({flaw, cell, vertex, text.str()});
  }
  std::string named(int v) const { return mesh_.vertex_name(v); }

  bool offsets_fit() {
    const bool fit = mesh_.offsets_fit();
    if (!fit)
      report(MeshFlaw::offsets, -1, -1,
             "the offsets of the cells must rise from 0 to the number of indices, ", mesh_.indices.size(),
             ": add cells by add_cell");
    return fit;
  }

  bool has_vertices(int c) {
    const std::span<const int> corners = mesh_.cell(c);
    const std::size_t n_before = defects.size();
    if (corners.size() < 3)
      report(MeshFlaw::too_few_vertices, c, corners.empty() ? -1 : corners[0], "cell ", c, " has ",
             corners.size(), " vertices: give it three at least, or leave it out");
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int v = corners[k];
      if (v < 0 || v >= mesh_.vertices.cols())
        report(MeshFlaw::index_out_of_range, c, v, "cell ", c, " has a vertex ", v,
               ", but vertices are numbered 0 to ", mesh_.vertices.cols() - 1,
               ": correct the number, or add the vertex");
      else if (std::find(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(k), v) !=
               corners.begin() + static_cast<std::ptrdiff_t>(k))
        report(MeshFlaw::repeated_vertex, c, v, "cell ", c, " has ", named(v),
               " twice: leave one out, or cut the cell");
    }
    return defects.size() == n_before;
  }

  bool has_places(int c) {
    for (const int v : mesh_.cell(c))
      if (!mesh_.vertices.col(v).allFinite()) {
        report(MeshFlaw::not_finite, c, v, named(v), " of cell ", c,
               " is nowhere: give it finite coordinates");
        return false;
      }
    return true;
  }

  void inspect_shape(int c) {
    const std::span<const int> corners = mesh_.cell(c);
    if (polygon_.cols() < static_cast<Index>(corners.size()))
      polygon_.resize(2, static_cast<Index>(corners.size()));
    for (std::size_t k = 0; k < corners.size(); ++k)
      polygon_.col(static_cast<Index>(k)) = mesh_.vertices.col(corners[k]);
    const PointsRef polygon = polygon_.leftCols(static_cast<Index>(corners.size()));
    bool clockwise = false;
    if (!is_clearly_convex(polygon)) {
      if (const auto defect = find_defect(polygon)) return report_outline(c, *defect);
      clockwise = signed_area(polygon) < 0;
      if (clockwise)
        report(MeshFlaw::clockwise, c, corners[0], "cell ", c, ", which begins with ", named(corners[0]),
               ", runs clockwise: reverse its vertices");
    }
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const int from = corners[k], to = corners[k + 1 < corners.size() ? k + 1 : 0];
      edges_.push_back(clockwise ? CellEdge{to, from, c} : CellEdge{from, to, c});
    }
  }

  void report_outline(int c, const DefectiveVertex& defect) {
    const int vertex = mesh_.cell(c)[defect.vertex], other = mesh_.cell(c)[defect.other];
    switch (defect.defect) {
      case PolygonDefect::repeated_vertex:
        return report(MeshFlaw::repeated_vertex, c, vertex, named(vertex), " and ", named(other), " of cell ",
                      c, " are at the same place: leave one out");
      case PolygonDefect::self_intersection:
        return report(MeshFlaw::self_intersection, c, vertex, "the outline of cell ", c,
                      " meets itself: its edge from ", named(vertex), " and that from ", named(other),
                      "; give its vertices in their order along the outline, or cut the cell");
      default:
        report(MeshFlaw::no_area, c, vertex, "cell ", c, " with ", named(vertex),
               " has no area: leave it out, or move a vertex");
    }
  }

  void inspect_edges() {
    const UnpairedEdges unpaired = unpaired_edges(edges_, static_cast<int>(mesh_.vertices.cols()));
    for (const EdgeOverlap& overlap : unpaired.overlaps)
      report(MeshFlaw::overlap, overlap.edge.cell, overlap.edge.from, description(overlap, mesh_));
    bool fits = unpaired.overlaps.empty();
    std::set<std::pair<int, int>> cracks;
    for (const auto& [vertex, edge, end] : touching_vertices(mesh_.vertices, unpaired.single, sizes())) {
      const std::span<const int> corners = mesh_.cell(edge.cell);
      if (end < 0 && std::find(corners.begin(), corners.end(), vertex) != corners.end())
        continue;  // of a thin cell, known to be simple
      fits = false;
      if (end < 0)
        report(MeshFlaw::hanging_vertex, edge.cell, vertex, named(vertex), " lies inside the edge from ",
               named(edge.from), " to ", named(edge.to), " of cell ", edge.cell,
               ": insert it there between them");
      else if (cracks.insert(std::minmax(vertex, end)).second)
        report(MeshFlaw::crack, edge.cell, std::max(vertex, end), "vertex ", std::min(vertex, end), " and ",
               named(std::max(vertex, end)), " (cell ", edge.cell,
               ") are at the same place: make them one, or cells part there");
    }
    if (fits) inspect_outlines(unpaired.single);
  }

  /// The length of the shortest edge at each vertex.
  VectorXd sizes() const {
    VectorXd size = VectorXd::Constant(mesh_.vertices.cols(), std::numeric_limits<double>::infinity());
    for (const CellEdge& edge : edges_) {
      const double length = (mesh_.vertices.col(edge.to) - mesh_.vertices.col(edge.from)).norm();
      for (const int v : {edge.from, edge.to}) size[v] = std::min(size[v], length);
    }
    return size;
  }

  void inspect_outlines(const std::vector<CellEdge>& outlines) {
    if (const auto overlap = find_overlap(mesh_.vertices, outlines)) {
      const auto& [a, b] = *overlap;
      report(MeshFlaw::overlap, b.cell, b.from, "cells lie on each other between the edge from ",
             named(b.from), " to ", named(b.to), " of cell ", b.cell, " and that from ", named(a.from),
             " to ", named(a.to), " of cell ", a.cell, ": move one of the parts away, or cut it");
    }
  }

  void look_for_unused_vertices() {
    std::vector<char> used(static_cast<std::size_t>(mesh_.vertices.cols()), 0);
    for (const int v : mesh_.indices)
      if (v >= 0 && v < mesh_.vertices.cols()) used[static_cast<std::size_t>(v)] = 1;
    for (std::size_t v = 0; v < used.size(); ++v)
      if (!used[v])
        report(MeshFlaw::unused_vertex, -1, static_cast<int>(v), named(static_cast<int>(v)),
               " belongs to no cell: leave it out");
  }

  const PolygonMesh& mesh_;
  Points polygon_;
  std::vector<CellEdge> edges_;  ///< of valid cells, counter-clockwise
};

}  // namespace

std::vector<MeshDefect> find_defects(const PolygonMesh& mesh) {
  return Inspection(mesh).defects;
}

void require_valid(const PolygonMesh& mesh) {
  const std::vector<MeshDefect> defects = find_defects(mesh);
  if (defects.empty()) return;
  std::string text =
      "the mesh has " + std::to_string(defects.size()) + (defects.size() == 1 ? " defect:" : " defects:");
  for (std::size_t k = 0; k < std::min(defects.size(), most_shown); ++k) text += "\n  " + defects[k].text;
  if (defects.size() > most_shown) text += "\n  and " + std::to_string(defects.size() - most_shown) + " more";
  throw Error(text);
}

}  // namespace polyfem
