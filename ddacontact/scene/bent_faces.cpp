#include <ddacontact/scene/bent_faces.hpp>

#include <ddacontact/core/quoted.hpp>

#include <algorithm>
#include <set>
#include <vector>

namespace ddacontact {

namespace {

constexpr double least_bend = 0.035;  ///< the sine of two degrees: less is no bend
constexpr double at_the_bend = 1e-4;  ///< distance over the size of the block with the face

struct FreeCorner {
  Vec2 at;
  int block;
};

/// Of all blocks that may move, by x.
std::vector<FreeCorner> free_corners(const BlockSystem& blocks, const Points& positions) {
  std::vector<FreeCorner> corners;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    for (int k = 0; blocks.is_movable(b) && k < blocks.block(b).n_vertices(); ++k)
      corners.push_back({positions.col(blocks.block(b).vertices().first + k), b});
  std::ranges::sort(corners, {}, [](const FreeCorner& corner) { return corner.at.x(); });
  return corners;
}

}  // namespace

std::optional<std::string> note_on_bent_face(const BlockSystem& blocks, const BlockState& initial) {
  const Points positions = blocks.positions(initial);
  const std::vector<FreeCorner> corners = free_corners(blocks, positions);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const int n = block.n_vertices();
    const auto vertex = [&](int k) -> Vec2 { return positions.col(block.vertices().first + k % n); };
    const double near = at_the_bend * block.size();
    for (int k = 0; k < n; ++k) {
      const Vec2 at = vertex(k), in = at - vertex(k + n - 1), out = vertex(k + 1) - at;
      if (cross(in, out) >= -least_bend * in.norm() * out.norm()) continue;
      std::set<int> there;
      auto corner =
          std::ranges::lower_bound(corners, at.x() - near, {}, [](const FreeCorner& c) { return c.at.x(); });
      for (; corner != corners.end() && corner->at.x() <= at.x() + near; ++corner)
        if (corner->block != b && (corner->at - at).norm() <= near) there.insert(corner->block);
      if (there.size() < 2) continue;
      return "the joint between block " + quoted(blocks.names[*there.begin()]) + " and block " +
             quoted(blocks.names[*std::next(there.begin())]) + " ends where the face of block " +
             quoted(blocks.names[b]) +
             " bends: a corner does not slide round the bend, which holds blocks that would fail (let the "
             "joint end above the bend)";
    }
  }
  return {};
}

}  // namespace ddacontact
