/// \file One moment of a run, as the files of frames keep it and pictures show it.
#pragma once

#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/output/block_field.hpp>
#include <ddacontact/output/labels.hpp>
#include <ddacontact/time/stepper.hpp>
#include <polyfem/basis/basis.hpp>

#include <map>
#include <span>
#include <string>
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

/// A polygon of a block in which the stress is smooth.
struct FrameCell {
  int block = 0;
  Range corners;                          ///< of Frame::corner_points and Frame::strain_displacement
  int elasticity = 0;                     ///< index into Frame::elasticity
  const polyfem::Basis* basis = nullptr;  ///< its shape functions; not owned
};

/// What a frame holds beside outlines and contacts. What is not requested is not computed.
struct FrameFields {
  bool displacement = true, velocity = true, stress = true;
};

/// One moment of a run. The points of the blocks are those of BlockState, one block after another: first the
/// vertices of its outline.
struct Frame {
  long step = 0;
  double time = 0;
  std::vector<Range> blocks;   ///< columns of the points: outlines, counter-clockwise
  std::vector<int> materials;  ///< of each block
  std::vector<std::string> material_names;
  std::vector<Mat3> elasticity;    ///< D of each material (9), Pa; then others that cells have
  std::vector<FrameCell> cells;    ///< one block after another
  std::vector<int> corner_points;  ///< of all cells: the point of each corner, counter-clockwise
  Points position;                 ///< of points, in the scene's coordinates
  Points displacement, velocity;   ///< of points; no columns: not requested
  Points strain_displacement;      ///< CellStress of each cell's corners; no columns: stress not requested
  Tensors stress_offset;           ///< CellStress of each cell; no columns: stress not requested
  Tensors mean_stress;             ///< of each block, the area average; no columns: not requested
  std::map<std::string, VectorXd> block_values;  ///< of each block, 0 where it is gone, by BlockField::name
  std::vector<FrameContact> contacts;

  int n_blocks() const { return static_cast<int>(blocks.size()); }
  /// Those that have cells, ascending: the others have been taken out of the run.
  std::vector<int> present_blocks() const;
  int n_cells() const { return static_cast<int>(cells.size()); }
  auto outline(int block) const { return position.middleCols(blocks[block].first, blocks[block].count); }
  /// The points of a block; the outline's are the first.
  Range points(int block) const;
  /// The points of the corners of a cell.
  std::span<const int> corners(int cell) const {
    return std::span(corner_points).subspan(cells[cell].corners.first, cells[cell].corners.count);
  }
  /// Adds the cell that is a block's whole outline, by Wachspress functions and the block's material.
  void add_outline_cell(int block);
  /// Whether every block is such a cell, and has no other points and no offset.
  bool has_outline_cells_only() const;
};

/// The present state of a run.
Frame capture_frame(const Stepper& stepper, const Labels& labels, const FrameFields& fields);

}  // namespace ddacontact
