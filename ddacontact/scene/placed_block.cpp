#include <ddacontact/scene/placed_block.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/scene/outline_distance.hpp>
#include <polyfem/geometry/area_moments.hpp>

#include <cmath>

namespace ddacontact {

namespace {

/// Points of a block's outline that are no further from another block than its cells are to be there, half of
/// that apart.
std::vector<Vec2> contact_zone(const Scene& scene, int block) {
  const double near = scene.blocks[block].mesh.at_contact;
  const Points& outline = scene.blocks[block].vertices;
  const Box own = bounding_box(outline, near);
  std::vector<const Points*> others;
  for (int b = 0; b < static_cast<int>(scene.blocks.size()); ++b)
    if (b != block && touch(own, bounding_box(scene.blocks[b].vertices)))
      others.push_back(&scene.blocks[b].vertices);
  std::vector<Vec2> zone;
  for (Index k = 0; k < outline.cols(); ++k) {
    const Vec2 start = outline.col(k), edge = outline.col((k + 1) % outline.cols()) - start;
    const int n = static_cast<int>(std::ceil(2 * edge.norm() / near));
    for (int i = 0; i < n; ++i) {
      const Vec2 x = start + static_cast<double>(i) / n * edge;
      for (const Points* other : others)
        if (scene_format::distance_to_outline(x, *other) <= near) {
          zone.push_back(x);
          break;
        }
    }
  }
  return zone;
}

}  // namespace

Vec2 low_corner(const Scene& scene) {
  Vec2 low = scene.blocks.front().vertices.col(0);
  for (const BlockDescription& block : scene.blocks) low = low.cwiseMin(block.vertices.rowwise().minCoeff());
  return low;
}

PlacedBlock placed_block(const Scene& scene, int index, const Vec2& origin) {
  const BlockDescription& block = scene.blocks[index];
  PlacedBlock placed{block.vertices.colwise() - origin, polyfem::signed_area(block.vertices) < 0, {}};
  if (placed.turned) placed.outline = placed.outline.rowwise().reverse().eval();
  if (block.model != BlockModel::mesh) return placed;
  std::vector<Vec2> contact;
  if (block.mesh.at_contact > 0) contact = contact_zone(scene, index);
  for (Vec2& x : contact) x -= origin;
  try {
    placed.mesh = divide(placed.outline, block.mesh, contact);
  } catch (const polyfem::Error& error) {
    throw Error("block \"" + scene.block_name(index) + "\" cannot be divided into a mesh: " + error.what());
  }
  return placed;
}

}  // namespace ddacontact
