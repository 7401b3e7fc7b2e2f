#include "hard_steps.hpp"

#include "overlap_area.hpp"
#include "step_record_text.hpp"

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
  write_record(out, record);
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
  return {path.stem().string(), *reading.scene, read_record(record)};
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

double largest_overlap(const ddacontact::Stepper& stepper) {
  const ddacontact::BlockSystem& blocks = stepper.blocks();
  double largest = 0;
  for (int a = 0; a < blocks.n_blocks(); ++a)
    for (int b = a + 1; b < blocks.n_blocks(); ++b) {
      if (!blocks.is_movable(a) && !blocks.is_movable(b)) continue;
      const polyfem::Points p = blocks.outline_from(stepper.state(), a, a),
                            q = blocks.outline_from(stepper.state(), b, a);
      if ((p.rowwise().minCoeff().array() > q.rowwise().maxCoeff().array()).any() ||
          (q.rowwise().minCoeff().array() > p.rowwise().maxCoeff().array()).any())
        continue;
      const double smaller = std::min(blocks.block(a).reference_area(), blocks.block(b).reference_area());
      largest = std::max(largest, overlap_area(p, q) / smaller);
    }
  return largest;
}

}  // namespace support
