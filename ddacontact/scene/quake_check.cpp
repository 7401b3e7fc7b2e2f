#include <ddacontact/scene/quake_check.hpp>

#include <ddacontact/scene/text.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

namespace {

bool shakes_between(const std::vector<Vec3>& history, double from, double to) {
  return std::ranges::adjacent_find(history, [&](const Vec3& a, const Vec3& b) {
           return a[0] < to && b[0] > from && !(a.tail<2>().isZero(0) && b.tail<2>().isZero(0));
         }) != history.end();
}

}  // namespace

void warn_of_early_quakes(const Document& document, const Scene& scene, ProblemList& problems) {
  const auto is_dynamic = [](const StageDescription& stage) { return stage.analysis.mode == Mode::dynamic; };
  const auto last = std::find_if(scene.stages.rbegin(), scene.stages.rend(), is_dynamic).base();
  std::vector<bool> told(scene.quakes.size(), document.goes_on);
  double begin = 0;
  for (auto stage = scene.stages.begin(); stage < last; ++stage) {
    const double end = begin + stage->analysis.steps * stage->analysis.time_step;
    for (std::size_t q = 0; q < scene.quakes.size(); ++q) {
      if (is_dynamic(*stage) || told[q] || !shakes_between(scene.quakes[q].acceleration.history, begin, end))
        continue;
      told[q] = true;
      problems.warning(
          document.quakes[q].locations.of("acceleration"),
          "the record shakes the ground between t = " + rounded(begin) + " and " + rounded(end) +
              " s, in a static stage, where it is a load without inertia",
          "its time counts from the start of the run: let it begin when the stage has ended, at t = " +
              rounded(end) + " s" + (stage->until ? " at the latest" : ""));
    }
    begin = end;
  }
}

}  // namespace ddacontact::scene_format
