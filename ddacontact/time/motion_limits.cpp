#include <ddacontact/time/motion_limits.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// Parts of a block's size: contacts are looked for at least and at most this far.
constexpr double least_reach = 0.01, largest_reach_ratio = 0.25;
/// A foreseen step uses this much of what is allowed: contacts accelerate too.
constexpr double foreseen_part = 0.9;

}  // namespace

void MotionLimits::set_analysis(const AnalysisOptions& analysis) {
  analysis_ = analysis;
  const Points& x = blocks_.reference();
  const double larger_side = (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
  largest_displacement_ = analysis.max_displacement_ratio * larger_side / 2;
}

double MotionLimits::largest_reach(int block) const {
  if (analysis_.preset == Preset::paper) return largest_displacement_;
  return std::min(largest_reach_ratio * blocks_.block(block).size(), largest_displacement_);
}

double MotionLimits::fastest_vertex(const BlockState& state, int block) const {
  const Block& of = blocks_.block(block);
  double fastest = 0;
  for (int v = 0; v < of.n_vertices(); ++v)
    fastest = std::max(fastest, of.vertex_map(v)(state.velocity).norm());
  return fastest;
}

std::vector<double> MotionLimits::speeds(const BlockState& state, const std::vector<Contact>& met) const {
  std::vector<double> own(blocks_.n_blocks());
  for (int b = 0; b < blocks_.n_blocks(); ++b) own[b] = fastest_vertex(state, b);
  std::vector<double> speeds = own;
  for (const Contact& contact : met) {
    const int a = contact.pair.vertex_block, b = contact.pair.edge_block;
    speeds[a] = std::max(speeds[a], own[b]);
    speeds[b] = std::max(speeds[b], own[a]);
  }
  return speeds;
}

std::vector<double> MotionLimits::reach(const BlockState& state, const std::vector<Contact>& met, double dt,
                                        double scale) const {
  const std::vector<double> speed = speeds(state, met);
  std::vector<double> reach(blocks_.n_blocks());
  const VectorXd prescribed = blocks_.prescribed(state, state.time + dt);
  const double fall = analysis_.gravity.norm() * dt * dt;
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    const Block& block = blocks_.block(b);
    if (!blocks_.is_movable(b)) {
      double furthest = 0;
      for (int v = 0; v < block.n_vertices(); ++v)
        furthest = std::max(furthest, block.vertex_map(v)(prescribed).norm());
      reach[b] = furthest;
    } else {
      const double expected = 2 * (speed[b] * dt + fall) + least_reach * block.size();
      reach[b] = std::min(scale * expected, largest_reach(b));
    }
  }
  return reach;
}

double MotionLimits::foreseen_step(const BlockState& state, const std::vector<Contact>& met) const {
  double longest = std::numeric_limits<double>::infinity();
  if (analysis_.mode == Mode::statics) return longest;
  const std::vector<double> speed = speeds(state, met);
  for (int b = 0; b < blocks_.n_blocks(); ++b) {
    if (!blocks_.is_movable(b)) continue;
    // v dt + g dt^2 / 2 = what is allowed, with v for the fastest vertex
    const double v = speed[b], g = analysis_.gravity.norm(), allowed = foreseen_part * largest_reach(b);
    if (v + g > 0) longest = std::min(longest, 2 * allowed / (v + std::sqrt(v * v + 2 * g * allowed)));
  }
  return longest;
}

}  // namespace ddacontact
