#include <ddacontact/time/stable_step.hpp>

#include <ddacontact/block/corotational_shape.hpp>

#include <algorithm>
#include <vector>

namespace ddacontact {

namespace {

/// What is linear is stable up to the critical step; blocks turn and lengths of substeps change.
constexpr double margin = 0.9;
/// A sliver's critical step is below this part of the median.
constexpr double sliver_part = 0.25;

}  // namespace

std::optional<StableStep> find_stable_step(const BlockSystem& blocks, const AnalysisOptions& analysis) {
  if (analysis.scheme != Scheme::central_difference || analysis.mode != Mode::dynamic) return {};
  struct Critical {
    double step;
    int block;
    bool operator<(const Critical& other) const { return step < other.step; }
  };
  std::vector<Critical> steps;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (const CorotationalShape* shape = blocks.block(b).shape(); shape && blocks.is_movable(b))
      steps.push_back({critical_step(*shape, analysis.damping), b});
  if (steps.empty()) return {};
  std::sort(steps.begin(), steps.end());
  const double sliver = sliver_part * steps[steps.size() / 2].step;
  const auto limit = std::find_if(steps.begin(), steps.end(),
                                  [&](const Critical& critical) { return critical.step >= sliver; });
  const double dt = margin * limit->step;
  const auto n_decaying =
      std::count_if(steps.begin(), steps.end(), [&](const Critical& critical) { return critical.step < dt; });
  return StableStep{dt, limit->step, limit->block, static_cast<int>(n_decaying)};
}

}  // namespace ddacontact
