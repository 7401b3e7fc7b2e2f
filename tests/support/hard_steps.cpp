#include "hard_steps.hpp"

#include <ddacontact/scene/reader.hpp>
#include <ddacontact/scene/writer.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>

namespace support {

namespace {

const std::string divider = "\n# record\n";

}  // namespace

void write_hard_step(const std::filesystem::path& path, const ddacontact::Scene& scene,
                     const ddacontact::StepRecord& record) {
  std::ofstream out(path);
  ddacontact::write_scene(out, scene);
  out << divider;
  ddacontact::write_record(out, record);
  if (!out.flush()) throw ddacontact::Error("cannot write " + path.string());
}

HardStep read_hard_step(const std::filesystem::path& path) {
  std::ifstream in(path);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  const std::size_t end = text.find(divider);
  if (end == std::string::npos) throw ddacontact::Error(path.string() + " holds no recorded step");
  const ddacontact::SceneReading reading = ddacontact::read_scene_text(text.substr(0, end), path.string());
  if (!reading.scene) throw ddacontact::Error(reading.problems.front().text());
  std::istringstream record(text.substr(end + divider.size()));
  return {path.stem().string(), *reading.scene, ddacontact::read_record(record)};
}

std::vector<HardStep> hard_steps() {
  std::vector<HardStep> steps;
  for (const auto& file : std::filesystem::directory_iterator(POLYDDA_HARD_STEPS))
    if (file.path().extension() == ".step") steps.push_back(read_hard_step(file.path()));
  std::sort(steps.begin(), steps.end(), [](const HardStep& a, const HardStep& b) { return a.name < b.name; });
  return steps;
}

ddacontact::BuiltScene build_at(const HardStep& step) {
  ddacontact::BuiltScene built = ddacontact::build(step.scene);
  built.stepper->restore(step.record);
  return built;
}

}  // namespace support
