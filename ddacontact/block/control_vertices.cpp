#include <ddacontact/block/control_vertices.hpp>

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

namespace ddacontact {

namespace {

/// Three vertices, held ones first, spread as widely as a greedy choice makes them.
decltype(ControlVertices::x) choose_three(const PointsRef& outline, const std::vector<bool>& held) {
  const int n = static_cast<int>(outline.cols());
  const auto best = [&](const auto& score) {
    return std::ranges::max(std::views::iota(0, n), {},
                            [&](int v) { return std::pair(held[v] && score(v) > 0, score(v)); });
  };
  const int a = best([](int) { return 1.0; });
  const Vec2 p = outline.col(a);
  const int b = best([&](int v) { return (outline.col(v) - p).norm(); });
  const Vec2 edge = outline.col(b) - p;
  const int c =
      best([&](int v) { return v == a || v == b ? 0.0 : std::abs(cross(edge, outline.col(v) - p)); });
  return {a, b, c};
}

}  // namespace

ControlVertices choose_control_vertices(const PointsRef& outline, const std::vector<bool>& fixed_x,
                                        const std::vector<bool>& fixed_y) {
  return {choose_three(outline, fixed_x), choose_three(outline, fixed_y)};
}

}  // namespace ddacontact
