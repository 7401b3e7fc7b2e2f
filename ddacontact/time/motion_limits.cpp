#include <ddacontact/time/motion_limits.hpp>

#include <ddacontact/core/for_all.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

/// Parts of a block's size: contacts are looked for at least and at most this far.
constexpr double least_margin = 0.01, largest_margin_ratio = 0.25;
/// A predicted step uses this much of what is allowed: contacts accelerate too.
constexpr double predicted_part = 0.9;

MotionLimits::MotionLimits(const BlockSystem& blocks, const AnalysisOptions& analysis) {
  const Points x = blocks.reference();
  half_larger_side_ = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff() / 2;
  set_analysis(analysis);
}

void MotionLimits::set_analysis(const AnalysisOptions& analysis) {
  analysis_ = analysis;
  largest_displacement_ = analysis.max_displacement_ratio * half_larger_side_;
}

double MotionLimits::largest_search_margin(const Block& block) const {
  if (analysis_.preset == Preset::paper) return largest_displacement_;
  return std::min(largest_margin_ratio * block.size(), largest_displacement_);
}

void MotionLimits::find_speeds(const BlockSystem& blocks, const BlockState& state,
                               const std::vector<ContactRecord>& met) {
  own_speed_.resize(blocks.n_blocks());
  for_all(blocks.n_blocks(),
          [&](int b) { own_speed_[b] = blocks.block(b).furthest_vertex(state.going_on()); });
  speed_ = own_speed_;
  for (const ContactRecord& contact : met) {
    const int a = contact.pair.vertex_block, b = contact.pair.edge_block;
    speed_[a] = std::max(speed_[a], own_speed_[b]);
    speed_[b] = std::max(speed_[b], own_speed_[a]);
  }
}

const std::vector<double>& MotionLimits::search_margin(const BlockSystem& blocks, const BlockState& state,
                                                       const std::vector<ContactRecord>& met, double dt,
                                                       double scale) {
  assert(dt > 0 && scale > 0);
  find_speeds(blocks, state, met);
  search_margin_.assign(blocks.n_blocks(), 0);
  VectorXd prescribed;
  const double fall = analysis_.gravity.norm() * dt * dt;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    if (blocks.is_unchanging(b)) continue;
    if (!blocks.is_movable(b)) {
      if (prescribed.size() == 0) prescribed = blocks.prescribed(state, state.time + dt);
      search_margin_[b] = block.furthest_vertex(prescribed) + least_margin * block.size();
    } else {
      const double expected = 2 * (speed_[b] * dt + fall) + least_margin * block.size();
      search_margin_[b] = std::min(scale * expected, largest_search_margin(block));
    }
  }
  return search_margin_;
}

double MotionLimits::predicted_step(const BlockSystem& blocks, const BlockState& state,
                                    const std::vector<ContactRecord>& met) {
  double longest = inf;
  if (analysis_.mode == Mode::statics) return longest;
  find_speeds(blocks, state, met);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!blocks.is_movable(b)) continue;
    // v dt + g dt^2 / 2 = what is allowed, with v for the fastest vertex
    const double v = speed_[b], g = analysis_.gravity.norm(),
                 allowed = predicted_part * largest_search_margin(blocks.block(b));
    if (v + g > 0) longest = std::min(longest, 2 * allowed / (v + std::sqrt(v * v + 2 * g * allowed)));
  }
  return longest;
}

}  // namespace ddacontact
