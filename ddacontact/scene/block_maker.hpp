/// \file The blocks of an analysis from those of a scene.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/block/control_vertices.hpp>
#include <ddacontact/scene/congruent_shapes.hpp>
#include <ddacontact/scene/holds.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// A block's numbering is known only when all blocks are: what to hold is said by local numbers first.
struct LocalHold {
  int unknown, vertex, axis;
  TimeFunction motion;
};

/// Makes blocks of the models that a scene states, with what holds them.
class BlockMaker {
 public:
  /// All of these must outlive it.
  BlockMaker(const Scene& scene, const std::vector<PlacedBlock>& placed, const std::vector<Holds>& holds,
             std::vector<std::string>& notes);

  std::unique_ptr<Block> make(int b);

  std::vector<std::vector<LocalHold>> local_holds;  ///< of each block made
  std::vector<FixedVertex> springs;                 ///< that hold vertices of six-unknown blocks

 private:
  /// All of a fixed block is held.
  std::unique_ptr<Block> make_mesh_block(int b, const BlockMaterial& material);
  std::unique_ptr<Block> make_affine_block(int b, const BlockMaterial& material);
  std::unique_ptr<Block> affine_block(int b, const BlockMaterial& material,
                                      const std::optional<ControlVertices>& control);
  bool corotational() const { return scene_.analysis.kinematics == Kinematics::corotational; }

  const Scene& scene_;
  const std::vector<PlacedBlock>& placed_;
  const std::vector<Holds>& holds_;
  std::vector<std::string>& notes_;
  CongruentShapes shapes_;
};

}  // namespace ddacontact
