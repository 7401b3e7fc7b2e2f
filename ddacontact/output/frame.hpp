/// \file One moment of a run, as the files of frames keep it and pictures show it.
#pragma once

#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/output/labels.hpp>
#include <ddacontact/time/stepper.hpp>
#include <polyfem/basis/basis.hpp>

#include <vector>

namespace ddacontact {

/// A contact that was closed at any time in the last step, at the end of that step.
struct FrameContact {
  int vertex_block = 0, edge_block = 0;
  Vec2 position{0, 0};  ///< of the vertex, in the scene's coordinates
  Vec2 normal{0, 0};    ///< unit vector out of the edge's block: where a normal force > 0 pushes the vertex
  double gap = 0;       ///< m; < 0 is penetration
  double normal_force = 0, shear_force = 0;  ///< on the vertex, N per m; shear along the normal turned left
  ContactState state = ContactState::open;

  /// On the vertex's block; the edge's block feels the opposite.
  Vec2 force() const { return normal_force * normal + shear_force * Vec2(-normal.y(), normal.x()); }
};

/// What a frame holds beside outlines and contacts. What is not asked for is not computed.
struct FrameFields {
  bool displacement = true, velocity = true, stress = true;
};

/// One moment of a run.
struct Frame {
  long step = 0;
  double time = 0;
  std::vector<Range> blocks;   ///< of the columns below, one after another: outlines, counter-clockwise
  std::vector<int> materials;  ///< of each block
  std::vector<std::string> material_names;
  std::vector<Mat3> elasticity;   ///< D of each material (9), Pa
  Points position;                ///< of outline vertices, in the scene's coordinates
  Points displacement, velocity;  ///< of outline vertices; no columns: not asked for
  Points strain_displacement;     ///< Block::strain_displacement; no columns: stress not asked for
  Tensors mean_stress;            ///< of each block, the area average; no columns: not asked for
  std::vector<FrameContact> contacts;

  int n_blocks() const { return static_cast<int>(blocks.size()); }
  auto outline(int block) const { return position.middleCols(blocks[block].first, blocks[block].count); }
  /// Stress (xx, yy, xy) of a block by its shape functions at a point of its closed outline.
  Vec3 stress(int block, const polyfem::ShapeValues& shape) const;
  /// The same at a vertex, where the functions' gradients are those of the triangle with its neighbours.
  Vec3 stress_at_vertex(int block, int vertex) const;
};

/// The present state of a run.
Frame capture_frame(const Stepper& stepper, const Labels& labels, const FrameFields& fields);

}  // namespace ddacontact
