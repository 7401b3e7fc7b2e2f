#include <ddacontact/scene/scene.hpp>

#include <algorithm>

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

int Scene::joint_of_edge(int block, int edge, int other) const {
  const std::vector<int>& of_edges = blocks[block].edge_joints;
  if (!of_edges.empty() && of_edges[edge] >= 0) return of_edges[edge];
  const auto [a, b] = std::minmax(blocks[block].material, blocks[other].material);
  const auto number_of = [&](const std::optional<std::array<int, 2>>& between) {
    return static_cast<int>(std::ranges::find(joints, between, &Joint::between) - joints.begin());
  };
  const int of_materials = number_of(std::array{a, b});
  return of_materials < static_cast<int>(joints.size()) ? of_materials : number_of(std::nullopt);
}

double Scene::end_time() const {
  if (stages.empty()) return analysis.steps * analysis.time_step;
  double sum = 0;
  for (const StageDescription& stage : stages) sum += stage.analysis.steps * stage.analysis.time_step;
  return sum;
}

}  // namespace ddacontact
