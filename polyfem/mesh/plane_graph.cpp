#include <polyfem/mesh/plane_graph.hpp>

#include <polyfem/geometry/predicates.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace polyfem {

namespace {

/// Whether a comes before b counter-clockwise from the direction of x, both not zero.
bool turns_before(const Vec2& centre, const Vec2& a, const Vec2& b) {
  const auto is_lower = [&](const Vec2& p) {
    return p.y() < centre.y() || (p.y() == centre.y() && p.x() < centre.x());
  };
  if (is_lower(a) != is_lower(b)) return is_lower(b);
  return orientation(centre, a, b) > 0;
}

/// The half-edges that start at each vertex, counter-clockwise.
struct Stars {
  std::vector<int> first, half_edges;

  explicit Stars(const NodedLines& graph)
      : first(graph.vertices.size() + 1, 0), half_edges(2 * graph.edges.size()) {
    for (const NodedLines::Edge& edge : graph.edges) {
      ++first[edge.from + 1];
      ++first[edge.to + 1];
    }
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<int> end(first.begin(), first.end() - 1);
    for (int h = 0; h < static_cast<int>(half_edges.size()); ++h) half_edges[end[start_of(graph, h)]++] = h;
    for (std::size_t v = 0; v < graph.vertices.size(); ++v)
      std::sort(half_edges.begin() + first[v], half_edges.begin() + first[v + 1], [&](int a, int b) {
        return turns_before(graph.vertices[v], graph.vertices[start_of(graph, a ^ 1)],
                            graph.vertices[start_of(graph, b ^ 1)]);
      });
  }
};

/// A root for each vertex: the same for vertices that edges join.
std::vector<int> parts_of(const NodedLines& graph) {
  std::vector<int> root(graph.vertices.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const NodedLines::Edge& edge : graph.edges) root[find(edge.from)] = find(edge.to);
  for (std::size_t v = 0; v < root.size(); ++v) root[v] = find(static_cast<int>(v));
  return root;
}

/// Adds an edge from a vertex along a horizontal line, to the left or the right, as far as the next edge; one
/// that is met between its ends is divided there. False: the edge is there.
bool connect(NodedLines& graph, int vertex, bool to_the_left, int mark) {
  const Vec2 from = graph.vertices[vertex];
  const double sign = to_the_left ? -1 : 1;
  double nearest = std::numeric_limits<double>::infinity();
  int met_vertex = -1, met_edge = -1;
  for (int e = 0; e < static_cast<int>(graph.edges.size()); ++e) {
    const int v = graph.edges[e].from, w = graph.edges[e].to;
    const Vec2 a = graph.vertices[v], b = graph.vertices[w];
    for (const int end : {v, w}) {
      const double ahead = sign * (graph.vertices[end].x() - from.x());
      if (graph.vertices[end].y() != from.y() || ahead <= 0 || ahead > nearest) continue;
      nearest = ahead;
      met_vertex = end;
    }
    if (std::min(a.y(), b.y()) >= from.y() || std::max(a.y(), b.y()) <= from.y()) continue;
    const double x = a.x() + (from.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    const double ahead = sign * (x - from.x());
    if (ahead <= 0 || ahead >= nearest) continue;
    nearest = ahead;
    met_vertex = -1;
    met_edge = e;
  }
  if (met_vertex < 0) {
    met_vertex = static_cast<int>(graph.vertices.size());
    graph.vertices.emplace_back(from.x() + sign * nearest, from.y());
    NodedLines::Edge& divided = graph.edges[met_edge];
    const NodedLines::Edge rest{met_vertex, divided.to, divided.mark};
    divided.to = met_vertex;
    graph.edges.push_back(rest);
  } else if (std::ranges::any_of(graph.edges, [&](const NodedLines::Edge& edge) {
               return std::minmax(edge.from, edge.to) == std::minmax(vertex, met_vertex);
             })) {
    return false;
  }
  graph.edges.push_back({vertex, met_vertex, mark});
  return true;
}

/// The leftmost and the rightmost of some vertices, the lowest of several.
std::pair<int, int> ends_of(const NodedLines& graph, std::span<const int> vertices) {
  const auto left_of = [&](int v, int w) {
    const Vec2 &p = graph.vertices[v], &q = graph.vertices[w];
    return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y());
  };
  const auto [left, right] = std::minmax_element(vertices.begin(), vertices.end(), left_of);
  return {*left, *right};
}

int connect_islands(NodedLines& graph, int mark) {
  const std::vector<int> root = parts_of(graph);
  std::vector<int> order;
  std::unordered_map<int, std::vector<int>> islands;
  for (const NodedLines::Edge& edge : graph.edges) {
    const int part = root[edge.from];
    if (part == root[graph.edges.front().from]) continue;
    std::vector<int>& vertices = islands[part];
    if (vertices.empty()) order.push_back(part);
    vertices.insert(vertices.end(), {edge.from, edge.to});
  }
  int n_added = 0;
  for (const int part : order) {
    const auto [left, right] = ends_of(graph, islands[part]);
    n_added += connect(graph, left, true, mark) + connect(graph, right, false, mark);
  }
  return n_added;
}

double walk_area(const NodedLines& graph, std::span<const int> vertices) {
  double twice = 0;
  const Vec2 origin = graph.vertices[vertices.front()];
  for (std::size_t k = 0; k < vertices.size(); ++k)
    twice += cross(graph.vertices[vertices[k]] - origin,
                   graph.vertices[vertices[(k + 1) % vertices.size()]] - origin);
  return twice / 2;
}

/// Of the two loops of a walk that passes a vertex twice the inner one, from that vertex on; nothing of
/// another walk.
std::vector<int> pinched_loop(const NodedLines& graph, std::span<const int> walk) {
  std::unordered_map<int, std::size_t> seen;
  std::vector<int> vertices;
  for (const int h : walk) vertices.push_back(start_of(graph, h));
  for (std::size_t k = 0; k < vertices.size(); ++k) {
    const auto [first, is_new] = seen.try_emplace(vertices[k], k);
    if (is_new) continue;
    const auto begin = vertices.begin() + static_cast<std::ptrdiff_t>(first->second),
               end = vertices.begin() + static_cast<std::ptrdiff_t>(k);
    std::vector<int> loop(begin, end);
    if (walk_area(graph, loop) < 0) return loop;
    vertices.erase(begin, end);
    std::rotate(vertices.begin(), vertices.begin() + static_cast<std::ptrdiff_t>(first->second),
                vertices.end());
    return vertices;
  }
  return {};
}

int connect_pinched(NodedLines& graph, int mark) {
  const FaceWalks walks = walk_faces(graph);
  int n_added = 0;
  for (int w = 0; w < walks.n_walks(); ++w) {
    const std::vector<int> loop = pinched_loop(graph, walks.walk(w));
    if (loop.empty()) continue;
    const auto [left, right] = ends_of(graph, loop);
    if (walk_area(graph, loop) >= 0) continue;
    n_added += left == loop.front() ? connect(graph, right, false, mark) : connect(graph, left, true, mark);
  }
  return n_added;
}

}  // namespace

FaceWalks walk_faces(const NodedLines& graph) {
  const Stars stars(graph);
  std::vector<int> next(stars.half_edges.size());
  for (std::size_t v = 0; v < graph.vertices.size(); ++v) {
    const int begin = stars.first[v], end = stars.first[v + 1];
    for (int k = begin; k < end; ++k)
      next[stars.half_edges[k] ^ 1] = stars.half_edges[k > begin ? k - 1 : end - 1];
  }
  FaceWalks walks;
  walks.walk_of.assign(next.size(), -1);
  for (int h = 0; h < static_cast<int>(next.size()); ++h) {
    if (walks.walk_of[h] >= 0) continue;
    for (int k = h; walks.walk_of[k] < 0; k = next[k]) {
      walks.walk_of[k] = walks.n_walks();
      walks.half_edges.push_back(k);
    }
    walks.offsets.push_back(static_cast<int>(walks.half_edges.size()));
  }
  return walks;
}

int remove_bridges(NodedLines& graph, double counted) {
  const FaceWalks walks = walk_faces(graph);
  std::size_t e = 0;
  int n_counted = 0;
  std::erase_if(graph.edges, [&](const NodedLines::Edge& edge) {
    const bool same = walks.walk_of[2 * e] == walks.walk_of[2 * e + 1];
    ++e;
    n_counted += same && (graph.vertices[edge.to] - graph.vertices[edge.from]).norm() > counted;
    return same;
  });
  return n_counted;
}

int connect_parts(NodedLines& graph, int mark) {
  int n_added = connect_islands(graph, mark);
  while (const int n = connect_pinched(graph, mark)) n_added += n;
  return n_added;
}

}  // namespace polyfem
