#include <ddacontact/time/stable_step.hpp>

#include <ddacontact/block/corotational_shape.hpp>
#include <ddacontact/core/quoted.hpp>

#include <algorithm>
#include <vector>

namespace ddacontact {

/// A sliver's critical step is below this part of that below which one block in so many is.
constexpr double sliver_part = 0.25;
constexpr std::size_t one_in = 20;
/// Damping may make a critical step so many times shorter.
constexpr double most_shortened = 10;

std::optional<StableStep> find_stable_step(const BlockSystem& blocks, const AnalysisOptions& analysis) {
  if (analysis.scheme != Scheme::central_difference || analysis.mode != Mode::dynamic) return {};
  struct Limit {
    double dt;
    int block;
  };
  std::vector<Limit> limits;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const CorotationalShape* const shape = blocks.block(b).shape();
    if (!shape || !blocks.is_movable(b)) continue;
    limits.push_back({longest_explicit_step(*shape, analysis.damping), b});
  }
  if (limits.empty()) return {};
  std::ranges::sort(limits, {}, &Limit::dt);
  const double sliver = sliver_part * limits[limits.size() / one_in].dt;
  const auto limit = std::ranges::find_if(limits, [&](const Limit& of) { return of.dt >= sliver; });
  const CorotationalShape& shape = *blocks.block(limit->block).shape();
  const double critical = critical_step(shape, analysis.damping), undamped = critical_step(shape, {});
  if (most_shortened * critical < undamped)
    throw Error("damping makes explicit steps of block " + quoted(blocks.names[limit->block]) + " " +
                std::to_string(undamped / critical) +
                " times shorter (a smaller stiffness of 'damping', or scheme = \"decaying\")");
  const double dt = std::min(limit->dt, analysis.time_step);
  const auto n_decaying = std::ranges::count_if(limits, [&](const Limit& of) { return of.dt < dt; });
  return StableStep{dt, critical, limit->block, static_cast<int>(n_decaying)};
}

}  // namespace ddacontact
