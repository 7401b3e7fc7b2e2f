/// \file The outline of a scene's block as the analysis has it, and its mesh.
#pragma once

#include <ddacontact/block/block_mesh.hpp>
#include <ddacontact/output/labels.hpp>
#include <ddacontact/scene/scene.hpp>

#include <optional>

namespace ddacontact {

/// A block's outline counter-clockwise, relative to the origin.
struct PlacedBlock {
  Points outline;
  bool turned;
  std::optional<BlockMesh> mesh;

  /// Of the scene's vertex, counted counter-clockwise.
  int ours(int scene_vertex) const {
    return turned ? static_cast<int>(outline.cols()) - 1 - scene_vertex : scene_vertex;
  }
  OutlineLabels labels() const {
    return mesh ? label_outline(mesh->n_outline, mesh->vertex, turned)
                : label_outline(static_cast<int>(outline.cols()), turned);
  }
  /// The number among the points of the block, of a vertex counted counter-clockwise.
  int point(int vertex) const { return mesh ? mesh->vertex[vertex] : vertex; }
};

/// The lowest coordinates of all blocks: the origin.
Vec2 low_corner(const Scene& scene);
/// The block of the scene relative to the origin.
PlacedBlock placed_block(const Scene& scene, int index, const Vec2& origin);

}  // namespace ddacontact
