#include <ddacontact/scene/bent_faces.hpp>

#include <ddacontact/core/quoted.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace ddacontact {

namespace {

constexpr double least_bend = 0.035;  ///< the sine of two degrees: less is no bend
constexpr double at_the_bend = 1e-4;  ///< distance over the size of the block with the face
/// Distance over the size of the block that ends there: one that slips so far and is held counts as at rest.
constexpr double before_the_bend = 0.03;

struct FreeCorner {
  Vec2 at, before, after;  ///< and the corners of its block beside it
  int block;
  double reach;  ///< how far before a bend it is as good as there, m
};

bool points_along(const Vec2& one, const Vec2& other) {
  return one.dot(other) > 0 && std::abs(cross(one, other)) <= least_bend * one.norm() * other.norm();
}

/// A face that runs `in` to a bend and `out` from it.
struct Bend {
  Vec2 at, in, out;
  double near;  ///< what is no further away is there, m

  bool is_at(const FreeCorner& corner) const { return (corner.at - at).norm() <= near; }
  /// Whether the block with this corner lies on one part of the face alone, from which gravity draws it
  /// towards the other part, which goes on forwards.
  bool stops(const FreeCorner& corner, const Vec2& gravity) const {
    const bool on_out = points_along(corner.before - corner.at, out),
               on_in = points_along(corner.after - corner.at, -in);
    const Vec2 way = on_out ? Vec2(-out) : in, way_left = at - corner.at;
    return in.dot(out) > 0 && on_in != on_out &&
           way.dot(gravity) > least_bend * way.norm() * gravity.norm() &&
           (is_at(corner) || (way_left.dot(way) > 0 && way_left.norm() <= corner.reach &&
                              std::abs(cross(way_left, way)) <= near * way.norm()));
  }
};

/// Of all blocks that may move, by x.
std::vector<FreeCorner> free_corners(const BlockSystem& blocks, const Points& positions) {
  std::vector<FreeCorner> corners;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const int n = blocks.block(b).n_vertices(), first = blocks.block(b).vertices().first;
    for (int k = 0; blocks.is_movable(b) && k < n; ++k)
      corners.push_back({positions.col(first + k), positions.col(first + (k + n - 1) % n),
                         positions.col(first + (k + 1) % n), b, before_the_bend * blocks.block(b).size()});
  }
  std::ranges::sort(corners, {}, [](const FreeCorner& corner) { return corner.at.x(); });
  return corners;
}

/// A bend of the face of a block, or of the faces of two.
struct BentFace {
  Bend bend;
  int in_block, out_block;

  bool is_of_one() const { return in_block == out_block; }
  std::string words(const BlockSystem& blocks) const {
    const std::string first = quoted(blocks.names[in_block]);
    return is_of_one() ? "where the face of block " + first + " bends: "
                       : "at the bend between the faces of blocks " + first + " and " +
                             quoted(blocks.names[out_block]) + ": ";
  }
};

std::vector<BentFace> bent_faces(const BlockSystem& blocks, const Points& positions,
                                 const std::vector<HeldCorner>& held) {
  std::vector<BentFace> faces;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const int n = block.n_vertices();
    const auto vertex = [&](int k) -> Vec2 { return positions.col(block.vertices().first + k % n); };
    for (int k = 0; k < n; ++k) {
      const Vec2 at = vertex(k);
      const Bend bend{at, at - vertex(k + n - 1), vertex(k + 1) - at, at_the_bend * block.size()};
      if (cross(bend.in, bend.out) < -least_bend * bend.in.norm() * bend.out.norm())
        faces.push_back({bend, b, b});
    }
  }
  for (const HeldCorner& corner : held)
    if (corner.is_first && corner.in_block != corner.out_block && corner.free > least_bend &&
        cross(corner.in, corner.out) < -least_bend)
      faces.push_back({{corner.at, corner.in, corner.out, at_the_bend * blocks.block(corner.block).size()},
                       corner.in_block,
                       corner.out_block});
  return faces;
}

std::string words_of_joint(const BlockSystem& blocks, const BentFace& face, int one, int other) {
  return "the joint between block " + quoted(blocks.names[one]) + " and block " +
         quoted(blocks.names[other]) + " ends " + face.words(blocks) +
         "a corner does not slide round the bend, which holds blocks that would fail "
         "(let the joint end above the bend)";
}

std::string words_of_foot(const BlockSystem& blocks, const BentFace& face, const FreeCorner& foot) {
  return "block " + quoted(blocks.names[foot.block]) + " ends " +
         (face.bend.is_at(foot) ? "" : "just before ") + face.words(blocks) +
         "its corner does not slide round the bend, which holds a block that would fail "
         "(let the face go on straight below the block, or the block end further from the bend)";
}

}  // namespace

std::optional<std::string> note_on_bent_face(const BlockSystem& blocks, const BlockState& initial,
                                             const std::vector<HeldCorner>& held) {
  const Points positions = blocks.positions(initial);
  const std::vector<FreeCorner> corners = free_corners(blocks, positions);
  double reach = 0;
  for (const FreeCorner& corner : corners) reach = std::max(reach, corner.reach);
  for (const BentFace& face : bent_faces(blocks, positions, held)) {
    const Bend& bend = face.bend;
    std::set<int> there;
    const FreeCorner* sliding = nullptr;
    const double furthest = std::max(bend.near, reach);
    auto corner = std::ranges::lower_bound(corners, bend.at.x() - furthest, {},
                                           [](const FreeCorner& c) { return c.at.x(); });
    for (; corner != corners.end() && corner->at.x() <= bend.at.x() + furthest; ++corner) {
      if (corner->block == face.in_block) continue;
      if (bend.is_at(*corner)) there.insert(corner->block);
      if (bend.stops(*corner, blocks.gravity)) sliding = &*corner;
    }
    if (face.is_of_one() && there.size() >= 2)
      return words_of_joint(blocks, face, *there.begin(), *std::next(there.begin()));
    if (sliding && there.size() < 2) return words_of_foot(blocks, face, *sliding);
  }
  return {};
}

}  // namespace ddacontact
