#include <ddacontact/scene/held_corners.hpp>

#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace ddacontact {

namespace {

constexpr double half_a_turn = std::numbers::pi;

/// What a block fills around a point of its outline: from one direction counter-clockwise by an angle.
struct Wedge {
  double from, angle;
  int block;
  bool is_vertex;
};

double direction(const Vec2& v) {
  return std::atan2(v.y(), v.x());
}
/// In [0, 2 pi).
double turn(double from, double to) {
  const double angle = std::fmod(to - from, 2 * half_a_turn);
  return angle < 0 ? angle + 2 * half_a_turn : angle;
}

/// Nothing where the point is not on the outline.
std::optional<Wedge> wedge_at(int block, const PointsRef& outline, const Vec2& at, double near) {
  const Index n = outline.cols();
  for (Index k = 0; k < n; ++k) {
    if ((outline.col(k) - at).norm() > near) continue;
    const double out = direction(outline.col((k + 1) % n) - outline.col(k));
    return Wedge{out, turn(out, direction(outline.col((k + n - 1) % n) - outline.col(k))), block, true};
  }
  for (Index k = 0; k < n; ++k) {
    const Vec2 along = outline.col((k + 1) % n) - outline.col(k), to = at - outline.col(k);
    const double length = along.norm(), s = to.dot(along) / length;
    if (s > 0 && s < length && std::abs(cross(along, to)) <= near * length)
      return Wedge{direction(along), half_a_turn, block, false};
  }
  return std::nullopt;
}

Vec2 unit(double angle) {
  return {std::cos(angle), std::sin(angle)};
}

/// Finds the largest gap between the wedges, two or more.
void find_free(std::vector<Wedge> wedges, HeldCorner& corner) {
  std::ranges::sort(wedges, {}, &Wedge::from);
  for (std::size_t k = 0; k < wedges.size(); ++k) {
    const Wedge &before = wedges[k], &after = wedges[(k + 1) % wedges.size()];
    const double free = turn(before.from, after.from) - before.angle;
    if (free <= corner.free) continue;
    corner.free = free;
    corner.in = -unit(before.from + before.angle);
    corner.in_block = before.block;
    corner.out = unit(after.from);
    corner.out_block = after.block;
  }
}

std::vector<char> staying(const BlockSystem& blocks, const std::vector<Stage>& stages) {
  std::vector<char> stays(static_cast<std::size_t>(blocks.n_blocks()));
  for (int b = 0; b < blocks.n_blocks(); ++b) stays[b] = blocks.is_held(b);
  for (const Stage& stage : stages)
    for (const std::vector<int>* changing : {&stage.removed, &stage.added})
      for (int b : *changing) stays[b] = 0;
  return stays;
}

}  // namespace

std::vector<HeldCorner> held_corners(const BlockSystem& blocks, const BlockState& initial,
                                     const std::vector<Stage>& stages) {
  const Points positions = blocks.positions(initial);
  const std::vector<char> stays = staying(blocks, stages);
  std::vector<int> held;
  std::vector<Box> boxes;
  const auto outline = [&](int b) { return blocks.block(b).vertices().columns_of(positions); };
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!stays[b]) continue;
    held.push_back(b);
    boxes.push_back(bounding_box(outline(b), coincidence * blocks.block(b).size()));
  }
  std::vector<std::vector<int>> beside(held.size());
  for (const auto& [k, l] : overlapping_pairs(boxes)) {
    beside[k].push_back(held[l]);
    beside[l].push_back(held[k]);
  }
  std::vector<HeldCorner> corners;
  for (std::size_t k = 0; k < held.size(); ++k) {
    const int b = held[k];
    const PointsRef own = outline(b);
    for (int v = 0; v < blocks.block(b).n_vertices(); ++v) {
      const Vec2 at = own.col(v);
      std::vector<Wedge> wedges{*wedge_at(b, own, at, 0)};
      for (int other : beside[k]) {
        const double near = coincidence * std::min(blocks.block(b).size(), blocks.block(other).size());
        if (const std::optional<Wedge> wedge = wedge_at(other, outline(other), at, near))
          wedges.push_back(*wedge);
      }
      if (wedges.size() < 2) continue;
      const bool is_first =
          std::ranges::none_of(wedges, [b](const Wedge& of) { return of.is_vertex && of.block < b; });
      HeldCorner corner{b, v, at, is_first, 0, Vec2::Zero(), Vec2::Zero(), b, b};
      find_free(std::move(wedges), corner);
      corners.push_back(corner);
    }
  }
  return corners;
}

}  // namespace ddacontact
