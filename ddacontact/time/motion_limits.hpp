/// \file How far blocks may move in one step, and how far ahead contacts are looked for.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/core/options.hpp>

#include <vector>

namespace ddacontact {

/// Shi's limit holds for every vertex: max_displacement_ratio times half the larger side of the box of the
/// scene at the start. No block may move further than its contacts were looked for: at most a quarter of its
/// size in the default preset, as far as Shi's limit in the paper preset.
class MotionLimits {
 public:
  MotionLimits(const BlockSystem& blocks, const AnalysisOptions& analysis);

  /// How far from each block to look for contacts in a step of length dt: twice the motion expected from its
  /// velocity and gravity and a little, times `scale`, m.
  std::vector<double> reach(const BlockState& state, double dt, double scale) const;
  /// The longest step that present velocities allow, s; infinity when nothing moves.
  double foreseen_step(const BlockState& state) const;

  /// No vertex of any block may move further than this in a step, m.
  double largest_displacement() const { return largest_displacement_; }
  /// The furthest that contacts of a block are ever looked for, m.
  double largest_reach(int block) const;

 private:
  double fastest_vertex(const BlockState& state, int block) const;

  const BlockSystem& blocks_;
  AnalysisOptions analysis_;
  double largest_displacement_;
};

}  // namespace ddacontact
