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

void MotionLimits::set_analysis(const AnalysisOptions& analysis) {
  analysis_ = analysis;
  const Points x = blocks_.reference();
  const double larger_side = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  // Shi's ratio is relative to half the larger side of the model.
  largest_displacement_ = analysis.max_displacement_ratio * larger_side / 2;
}

double MotionLimits::largest_search_margin(int block) const {
  if (analysis_.preset == Preset::paper) return largest_displacement_;
  return std::min(largest_margin_ratio * blocks_.block(block).size(), largest_displacement_);
}

void MotionLimits::find_speeds(const BlockState& state, const std::vector<ContactRecord>& met) {
  own_speed_.resize(blocks_.n_blocks());
  for_all(blocks_.n_blocks(),
          [&](int b) { own_speed_[b] = blocks_.block(b).furthest_vertex(state.going_on()); });
  speed_ = own_speed_;
  for (const ContactRecord& contact : met) {
    const int a = contact.pair.vertex_block, b = contact.pair.edge_block;
    speed_[a] = std::max(speed_[a], own_speed_[b]);
    speed_[b] = std::max(speed_[b], own_speed_[a]);
  }
}

const std::vector<double>& MotionLimits::search_margin(const BlockState& state,
                                                       const std::vector<ContactRecord>& met, double dt,
                                                       double scale) {
  assert(dt > 0 && scale > 0);
  find_speeds(state, met);
  search_margin_.assign(blocks_.n_blocks(), 0);
  VectorXd prescribed;
  const double fall = analysis_.gravity.norm() * dt * dt;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    if (blocks_.is_unchanging(b)) continue;
    if (!blocks_.is_movable(b)) {
      if (prescribed.size() == 0) prescribed = blocks_.prescribed(state, state.time + dt);
      search_margin_[b] = block.furthest_vertex(prescribed) + least_margin * block.size();
    } else {
      const double expected = 2 * (speed_[b] * dt + fall) + least_margin * block.size();
      search_margin_[b] = std::min(scale * expected, largest_search_margin(b));
    }
  }
  return search_margin_;
}

double MotionLimits::predicted_step(const BlockState& state, const std::vector<ContactRecord>& met) {
  double longest = inf;
  if (analysis_.mode == Mode::statics) return longest;
  find_speeds(state, met);
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (!blocks_.is_movable(b)) continue;
    // v dt + g dt^2 / 2 = what is allowed, with v for the fastest vertex
    const double v = speed_[b], g = analysis_.gravity.norm(),
                 allowed = predicted_part * largest_search_margin(b);
    if (v + g > 0) longest = std::min(longest, 2 * allowed / (v + std::sqrt(v * v + 2 * g * allowed)));
  }
  return longest;
}

}  // namespace ddacontact
