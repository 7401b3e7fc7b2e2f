#include "run_output.hpp"

#include <ddacontact/output/whole_file.hpp>
#include <ddacontact/scene/words.hpp>
#include <ddacontact/scene/writer.hpp>

#include <algorithm>

namespace dda {

using namespace ddacontact;

FrameOptions frame_options(const Scene& scene, int n_threads) {
  const OutputOptions& output = scene.output;
  const auto asked_for = [&](const char* field) { return std::ranges::count(output.fields, field) > 0; };
  return {.every = output.every,
          .displacement = asked_for("displacement"),
          .velocity = asked_for("velocity"),
          .stress = asked_for("stress"),
          .principal = asked_for("principal"),
          .n_threads = n_threads,
          .skip = scene.analysis.skip.output,
          .refine = output.refine};
}

void write_scene_file(const std::filesystem::path& path, const Scene& scene) {
  write_whole(path, [&](std::ostream& out) { write_scene(out, scene); });
}

std::string scheme_word(const Stepper& stepper) {
  const Scheme scheme = stepper.stages()[stepper.stage()].analysis.scheme;
  for (const auto& [text, choice] : scene_format::words_of(scheme))
    if (choice == scheme) return text;
  return {};
}

bool is_done(const Stepper& stepper, const std::optional<int>& steps) {
  if (stepper.is_over()) return true;
  if (steps) return stepper.counts().steps >= *steps;
  const bool in_last_stage = stepper.stage() + 1 == static_cast<int>(stepper.stages().size());
  return in_last_stage && stepper.stage_end().steps >= stepper.stages().back().analysis.steps;
}

}  // namespace dda
