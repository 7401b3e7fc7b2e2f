#include <polyfem/mesh/cut_cells.hpp>

#include <polyfem/geometry/area_moments.hpp>
#include <polyfem/geometry/validity.hpp>
#include <polyfem/mesh/plane_graph.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

namespace polyfem {

namespace {

/// The part of a segment in a box; nothing when it passes by.
std::optional<Segment> clipped(const Segment& segment, const Vec2& low, const Vec2& high) {
  const Vec2 along = segment.to - segment.from;
  double begin = 0, end = 1;
  for (const int axis : {0, 1}) {
    if (along[axis] == 0) {
      if (segment.from[axis] < low[axis] || segment.from[axis] > high[axis]) return std::nullopt;
      continue;
    }
    double in = (low[axis] - segment.from[axis]) / along[axis],
           out = (high[axis] - segment.from[axis]) / along[axis];
    if (in > out) std::swap(in, out);
    begin = std::max(begin, in);
    end = std::min(end, out);
  }
  if (!(begin < end)) return std::nullopt;
  return Segment{begin > 0 ? Vec2(segment.from + begin * along) : segment.from,
                 end < 1 ? Vec2(segment.from + end * along) : segment.to, segment.mark};
}

std::vector<Segment> segments_of(const PointsRef& domain, const std::vector<Segment>& lines) {
  std::vector<Segment> segments;
  for (Index k = 0; k < domain.cols(); ++k)
    segments.push_back({domain.col(k), domain.col((k + 1) % domain.cols()), outline_mark});
  const Vec2 low = domain.rowwise().minCoeff(), high = domain.rowwise().maxCoeff(),
             margin = Vec2::Constant((high - low).maxCoeff() / 64);
  for (const Segment& line : lines)
    if (const auto inside = clipped(line, low - margin, high + margin)) segments.push_back(*inside);
  return segments;
}

/// How firmly a vertex stays where it is.
enum class Hold { unused, none, outline, corner };

/// Calls visit(vertex, corner) for the vertices of the outline that noding made of corners of the domain: the
/// nearest, since a line through a corner may have made another one beside it, by round-off.
template <class Visit>
void visit_corners(const NodedLines& lines, const PointsRef& domain, Visit&& visit) {
  std::set<int> on_outline;
  for (const NodedLines::Edge& edge : lines.edges)
    if (edge.mark == outline_mark) on_outline.insert({edge.from, edge.to});
  for (Index k = 0; k < domain.cols(); ++k) {
    const auto distance = [&](int v) { return (lines.vertices[v] - domain.col(k)).cwiseAbs().maxCoeff(); };
    const auto nearest = std::ranges::min_element(on_outline, {}, distance);
    if (nearest != on_outline.end() && distance(*nearest) <= lines.grid) visit(*nearest, k);
  }
}

std::vector<Hold> hold_of(const NodedLines& lines, const PointsRef& domain) {
  std::vector<Hold> holds(lines.vertices.size(), Hold::unused);
  for (const NodedLines::Edge& edge : lines.edges)
    for (const int v : {edge.from, edge.to})
      holds[v] = std::max(holds[v], edge.mark == outline_mark ? Hold::outline : Hold::none);
  visit_corners(lines, domain, [&](int v, Index) { holds[v] = Hold::corner; });
  return holds;
}

/// Moves vertices to others within `snap`, to firmer ones where there are. Which moved or were moved to;
/// nothing when none did.
std::vector<bool> snap_vertices(NodedLines& lines, const std::vector<Hold>& holds, double snap) {
  std::vector<int> order;
  for (const Hold hold : {Hold::corner, Hold::outline, Hold::none})
    for (std::size_t v = 0; v < holds.size(); ++v)
      if (holds[v] == hold) order.push_back(static_cast<int>(v));
  using Square = std::array<std::int64_t, 2>;
  const auto hash = [](const Square& s) {
    return static_cast<std::size_t>(s[0]) * 0x9E3779B97F4A7C15u ^ static_cast<std::size_t>(s[1]);
  };
  std::unordered_map<Square, std::vector<int>, decltype(hash)> kept(order.size(), hash);
  std::vector<bool> moved;
  for (const int v : order) {
    const Vec2 at = lines.vertices[v];
    const Square square{std::llround(at.x() / snap), std::llround(at.y() / snap)};
    int target = -1;
    for (std::int64_t dx = -1; holds[v] != Hold::corner && dx <= 1 && target < 0; ++dx)
      for (std::int64_t dy = -1; dy <= 1 && target < 0; ++dy)
        if (const auto near = kept.find({square[0] + dx, square[1] + dy}); near != kept.end())
          for (const int w : near->second)
            if (target < 0 && (lines.vertices[w] - at).norm() <= snap) target = w;
    if (target < 0) {
      kept[square].push_back(v);
      continue;
    }
    lines.vertices[v] = lines.vertices[target];
    moved.resize(holds.size());
    moved[v] = moved[target] = true;
  }
  return moved;
}

/// The edges around the faces that moved vertices touch, and around the next ones: others they cannot cross.
std::vector<bool> edges_near(const NodedLines& lines, std::vector<bool> vertices) {
  const FaceWalks walks = walk_faces(lines);
  std::vector<bool> is_near(walks.n_walks(), false);
  for (int ring = 0; ring < 2; ++ring) {
    for (std::size_t h = 0; h < walks.walk_of.size(); ++h)
      if (vertices[start_of(lines, static_cast<int>(h))])
        is_near[walks.walk_of[h]] = is_near[walks.walk_of[h ^ 1]] = true;
    for (std::size_t h = 0; h < walks.walk_of.size(); ++h)
      if (is_near[walks.walk_of[h]]) vertices[start_of(lines, static_cast<int>(h))] = true;
  }
  std::vector<bool> edges;
  for (std::size_t e = 0; e < lines.edges.size(); ++e)
    edges.push_back(is_near[walks.walk_of[2 * e]] || is_near[walks.walk_of[2 * e + 1]]);
  return edges;
}

/// Nodes some of the edges once more, after their vertices have moved.
void node_again(NodedLines& lines, const std::vector<bool>& again) {
  std::vector<Segment> segments;
  std::vector<NodedLines::Edge> kept;
  std::map<std::array<double, 2>, int> number;
  for (std::size_t e = 0; e < again.size(); ++e) {
    const NodedLines::Edge& edge = lines.edges[e];
    if (!again[e]) {
      kept.push_back(edge);
      continue;
    }
    for (const int v : {edge.from, edge.to})
      number.insert({{lines.vertices[v].x(), lines.vertices[v].y()}, v});
    if (lines.vertices[edge.from] != lines.vertices[edge.to])
      segments.push_back({lines.vertices[edge.from], lines.vertices[edge.to], edge.mark});
  }
  std::ranges::stable_sort(segments, {}, &Segment::mark);
  const NodedLines noded = node_lines(segments, lines.grid);
  std::vector<int> numbers;
  for (const Vec2& vertex : noded.vertices) {
    const auto [known, is_new] =
        number.insert({{vertex.x(), vertex.y()}, static_cast<int>(lines.vertices.size())});
    if (is_new) lines.vertices.push_back(vertex);
    numbers.push_back(known->second);
  }
  for (const NodedLines::Edge& edge : noded.edges)
    kept.push_back({numbers[edge.from], numbers[edge.to], edge.mark});
  lines.edges = std::move(kept);
}

void keep_inside(NodedLines& lines, const PointsRef& domain) {
  std::erase_if(lines.edges, [&](const NodedLines::Edge& edge) {
    return edge.mark != outline_mark &&
           !contains(domain, (lines.vertices[edge.from] + lines.vertices[edge.to]) / 2);
  });
}

NodedLines snapped_lines(const PointsRef& domain, const std::vector<Segment>& lines, double snap) {
  NodedLines noded = node_lines(segments_of(domain, lines), noding_grid(domain));
  keep_inside(noded, domain);
  const std::vector<bool> near = [&] {
    const NodedLines before = noded;
    const std::vector<bool> moved = snap_vertices(noded, hold_of(noded, domain), std::max(snap, noded.grid));
    return moved.empty() ? moved : edges_near(before, moved);
  }();
  if (!near.empty()) node_again(noded, near);
  visit_corners(noded, domain, [&](int v, Index k) { noded.vertices[v] = domain.col(k); });
  std::stable_partition(noded.edges.begin(), noded.edges.end(),
                        [](const NodedLines::Edge& edge) { return edge.mark == outline_mark; });
  return noded;
}

CutCell cell_of(const NodedLines& lines, std::span<const int> walk) {
  CutCell cell;
  for (const int h : walk) {
    cell.corners.push_back(start_of(lines, h));
    cell.marks.push_back(lines.edges[h / 2].mark);
  }
  return cell;
}

/// Whether corner k of a cell is none by its turn.
bool is_straight(const CutCells& cells, const CutCell& cell, std::size_t k) {
  constexpr double straight_turn = 1e-9;
  const std::size_t n = cell.corners.size(), before = (k + n - 1) % n;
  if (cell.marks[before] != cell.marks[k]) return false;
  const Vec2 p = cells.vertices[cell.corners[k]], in = p - cells.vertices[cell.corners[before]],
             out = cells.vertices[cell.corners[(k + 1) % n]] - p;
  const double turn = std::abs(cross(in, out));
  return in.dot(out) > 0 &&
         (turn <= straight_turn * in.norm() * out.norm() || turn <= 4 * cells.grid * (in + out).norm());
}

}  // namespace

Points CutCells::outline(const CutCell& cell) const {
  Points points(2, static_cast<Index>(cell.corners.size()));
  for (std::size_t k = 0; k < cell.corners.size(); ++k)
    points.col(static_cast<Index>(k)) = vertices[cell.corners[k]];
  return points;
}

CutCells cut_cells(const PointsRef& domain, const std::vector<Segment>& lines, double snap) {
  NodedLines graph = snapped_lines(domain, lines, snap);
  CutCells result;
  result.grid = graph.grid;
  result.n_dangling = remove_bridges(graph, 3 * snap);
  result.n_connecting = connect_parts(graph, connecting_mark);
  const FaceWalks walks = walk_faces(graph);
  result.vertices = graph.vertices;
  for (int w = 0; w < walks.n_walks(); ++w) {
    CutCell cell = cell_of(graph, walks.walk(w));
    if (signed_area(result.outline(cell)) > 0) result.cells.push_back(std::move(cell));
  }
  return result;
}

std::vector<std::vector<int>> neighbours(const CutCells& cells) {
  std::unordered_map<std::int64_t, int> cell_of_edge;
  const auto key = [](int from, int to) { return (static_cast<std::int64_t>(from) << 32) + to; };
  for (std::size_t c = 0; c < cells.cells.size(); ++c) {
    const std::vector<int>& corners = cells.cells[c].corners;
    for (std::size_t k = 0; k < corners.size(); ++k)
      cell_of_edge[key(corners[k], corners[(k + 1) % corners.size()])] = static_cast<int>(c);
  }
  std::vector<std::vector<int>> result(cells.cells.size());
  for (std::size_t c = 0; c < cells.cells.size(); ++c) {
    const std::vector<int>& corners = cells.cells[c].corners;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto beyond = cell_of_edge.find(key(corners[(k + 1) % corners.size()], corners[k]));
      result[c].push_back(beyond == cell_of_edge.end() ? -1 : beyond->second);
    }
  }
  return result;
}

int drop_straight_corners(CutCells& cells, bool keep_shared) {
  std::vector<bool> is_corner(cells.vertices.size(), false);
  for (const CutCell& cell : cells.cells)
    for (std::size_t k = 0; k < cell.corners.size(); ++k)
      if (!is_straight(cells, cell, k)) is_corner[cell.corners[k]] = true;
  int n_shared = 0;
  for (CutCell& cell : cells.cells) {
    CutCell rest;
    for (std::size_t k = 0; k < cell.corners.size(); ++k) {
      const bool shared = is_corner[cell.corners[k]];
      if (is_straight(cells, cell, k) && !(shared && keep_shared)) {
        n_shared += shared;
        continue;
      }
      rest.corners.push_back(cell.corners[k]);
      rest.marks.push_back(cell.marks[k]);
    }
    cell = std::move(rest);
  }
  std::erase_if(cells.cells, [](const CutCell& cell) { return cell.corners.size() < 3; });  // round-off
  return n_shared;
}

}  // namespace polyfem
