#include <ddacontact/scene/scene.hpp>

namespace ddacontact {

std::string Scene::block_name(int block) const {
  const std::string& name = blocks[block].name;
  return name.empty() ? std::to_string(block) : name;
}

int Scene::n_steps() const {
  if (stages.empty()) return analysis.steps;
  int sum = 0;
  for (const StageDescription& stage : stages) sum += stage.analysis.steps;
  return sum;
}

double Scene::end_time() const {
  if (stages.empty()) return analysis.steps * analysis.time_step;
  double sum = 0;
  for (const StageDescription& stage : stages) sum += stage.analysis.steps * stage.analysis.time_step;
  return sum;
}

}  // namespace ddacontact
