#include "run_output.hpp"

#include <ddacontact/output/output_error.hpp>
#include <ddacontact/scene/words.hpp>
#include <ddacontact/scene/writer.hpp>

#include <algorithm>
#include <fstream>

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
  std::filesystem::path part = path;
  std::ofstream out(part += ".part", std::ios::binary);
  write_scene(out, scene);
  out.close();
  std::error_code error;
  if (out) std::filesystem::rename(part, path, error);
  if (!out || error) {
    std::filesystem::remove(part, error);
    throw OutputError("cannot write \"" + path.string() + "\"");
  }
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
