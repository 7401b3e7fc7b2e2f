#include <polyfem/mesh/outline_overlap.hpp>

#include <polyfem/geometry/predicates.hpp>

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

namespace polyfem {
namespace {

/// What is left of what: vertical edges count as leaning to the right.
bool is_left(const Vec2& a, const Vec2& b) {
  return std::tuple(a.x(), a.y()) < std::tuple(b.x(), b.y());
}

/// An edge from left to right.
struct SweptEdge {
  Vec2 left, right;
  bool cell_above;
};

/// Whether edge a passes below edge b: right where the later one begins, or at its end if they begin
/// together.
bool is_below(const SweptEdge& a, const SweptEdge& b) {
  if (is_left(b.left, a.left)) {
    const int side = orientation(b.left, b.right, a.left);
    return (side != 0 ? side : orientation(b.left, b.right, a.right)) < 0;
  }
  const int side = orientation(a.left, a.right, b.left);
  return (side != 0 ? side : orientation(a.left, a.right, b.right)) > 0;
}

bool is_conflict(const SweptEdge& a, const SweptEdge& b) {
  if (a.cell_above == b.cell_above) return true;
  return a.left != b.left && a.right != b.right && a.left != b.right && a.right != b.left &&
         segments_intersect(a.left, a.right, b.left, b.right);
}

/// An end of an edge. Where some end and others begin, they end first.
struct Event {
  double x, y;
  bool begins;
  int edge;
  auto operator<=>(const Event&) const = default;
};

}  // namespace

std::optional<std::pair<CellEdge, CellEdge>> find_overlap(const Points& vertices,
                                                          const std::vector<CellEdge>& outlines) {
  std::vector<SweptEdge> edges;
  std::vector<Event> events;
  for (const CellEdge& outline : outlines) {
    Vec2 left = vertices.col(outline.from), right = vertices.col(outline.to);
    const bool rightwards = is_left(left, right);
    if (!rightwards) left.swap(right);
    events.push_back({left.x(), left.y(), true, static_cast<int>(edges.size())});
    events.push_back({right.x(), right.y(), false, static_cast<int>(edges.size())});
    edges.push_back({left, right, rightwards});
  }
  std::sort(events.begin(), events.end());

  const auto below = [&](int a, int b) { return is_below(edges[a], edges[b]); };
  std::set<int, decltype(below)> line(below);  // the edges across the sweep, from bottom to top
  std::vector<decltype(line)::iterator> position(edges.size());
  std::optional<std::pair<CellEdge, CellEdge>> overlap;
  const auto look_below = [&](auto upper) {
    if (overlap || upper == line.end() || upper == line.begin()) return;
    const int b = *upper, a = *std::prev(upper);
    if (is_conflict(edges[a], edges[b])) overlap.emplace(outlines[a], outlines[b]);
  };
  for (auto event = events.begin(); event != events.end() && !overlap;) {
    const auto next_position = std::find_if(
        event, events.end(), [&](const Event& other) { return other.x != event->x || other.y != event->y; });
    auto above = line.end();
    for (; event != next_position && !event->begins; ++event) above = line.erase(position[event->edge]);
    if (event == next_position) look_below(above);
    for (auto begin = event; begin != next_position; ++begin) {
      const auto [inserted, is_new] = line.insert(begin->edge);
      if (!is_new) return std::pair(outlines[*inserted], outlines[begin->edge]);
      position[begin->edge] = inserted;
    }
    for (; event != next_position; ++event) {
      look_below(position[event->edge]);
      look_below(std::next(position[event->edge]));
    }
  }
  return overlap;
}

}  // namespace polyfem
