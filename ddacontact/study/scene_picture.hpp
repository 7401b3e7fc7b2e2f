/// \file A scene before it is run, as SVG: blocks, joints, supports, loads and monitors.
#pragma once

#include <ddacontact/picture/colour.hpp>
#include <ddacontact/scene/scene.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// Blocks in a colour of their own instead of that of their material.
struct MarkedBlocks {
  std::vector<int> blocks;  ///< indices
  Colour colour;
  std::string name;  ///< in the legend
};

/// What a picture of a scene shows beside its blocks.
struct ScenePictureOptions {
  double width = 800;                 ///< px
  bool names = false;                 ///< of blocks and monitors
  bool numbers = false;               ///< of vertices and, slanted away from them, edges
  std::vector<MarkedBlocks> marks{};  ///< a block of several has the colour of the last
};

/// Blocks in the colour of their material, the faces they share in that of the joint that holds between them,
/// triangles below held vertices, arrows for loads (all alike: they show where and which way).
std::string draw(const Scene& scene, const ScenePictureOptions& options);

/// Where edges of two blocks lie on each other, and the joint between them.
struct SharedFace {
  int block_a = 0, block_b = 0, joint = 0;
  Vec2 from{0, 0}, to{0, 0};
};
/// Of all pairs of blocks.
std::vector<SharedFace> shared_faces(const Scene& scene);

}  // namespace ddacontact
