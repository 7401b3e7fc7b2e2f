/// \file How far blocks may move in one step, and how far ahead contacts are looked for.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/core/options.hpp>

#include <vector>

namespace ddacontact {

/// Shi's limit holds for every vertex: max_displacement_ratio times half the larger side of the box of the
/// scene at the start. No block may move further than its contacts were looked for: at most a quarter of its
/// size in the default preset, as far as Shi's limit in the paper preset.
class MotionLimits {
 public:
  /// Of all blocks of a run.
  MotionLimits(const BlockSystem& blocks, const AnalysisOptions& analysis);
  /// Sets the options of the steps from now on.
  void set_analysis(const AnalysisOptions& analysis);

  /// Distance from each block to look for contacts within in a step of length dt: twice the motion expected
  /// from its velocity, or that of the fastest of the blocks that it may meet, and gravity and a little,
  /// times `scale`, m. Valid until the next call.
  /// \param[in] met  contacts of the last step: who may meet whom
  const std::vector<double>& search_margin(const BlockSystem& blocks, const BlockState& state,
                                           const std::vector<ContactRecord>& met, double dt, double scale);
  /// The longest step that present velocities allow, s; infinity when nothing moves. A block that is hit is
  /// as fast as what hits it.
  double predicted_step(const BlockSystem& blocks, const BlockState& state,
                        const std::vector<ContactRecord>& met);

  /// No vertex of any block may move further than this in a step, m.
  double largest_displacement() const { return largest_displacement_; }
  /// The furthest that contacts of a block are ever looked for, m.
  double largest_search_margin(const Block& block) const;

 private:
  /// Writes into speed_ the speed of each block or, where larger, of the fastest one that it may meet, m/s.
  void find_speeds(const BlockSystem& blocks, const BlockState& state, const std::vector<ContactRecord>& met);

  double half_larger_side_;  ///< of the box of the scene at the start, m
  AnalysisOptions analysis_;
  double largest_displacement_ = 0;
  std::vector<double> own_speed_, speed_, search_margin_;  ///< of each block
};

}  // namespace ddacontact
