#include <ddacontact/scene/bending_in_stages.hpp>

#include <ddacontact/scene/model_choice.hpp>

#include <algorithm>
#include <map>

namespace ddacontact {

namespace {

/// Whether other forces act in a stage than in the one before.
bool loads_anew(const Stage& stage, const Stage& before) {
  return stage.has_new_loads() || !stage.removed.empty() || !stage.added.empty() || !stage.bolts.empty() ||
         stage.analysis.gravity != before.analysis.gravity || !(stage.water == before.water);
}

/// Blocks whose supports end at different displacements.
std::vector<char> deformed_by_supports(const BlockSystem& blocks) {
  std::vector<char> deformed(static_cast<std::size_t>(blocks.n_blocks()), 0);
  std::map<std::pair<int, int>, double> first;  // of a block along an axis
  for (const PrescribedDof& held : blocks.prescribed_dofs()) {
    const int block = blocks.block_of_point(held.vertex);
    const double end = held.motion.at(blocks.end_time, blocks.end_time)[held.axis];
    if (first.try_emplace({block, held.axis}, end).first->second != end) deformed[block] = 1;
  }
  return deformed;
}

}  // namespace

std::vector<double> missing_in_stages(BlockSystem& blocks, BlockState initial,
                                      const ContactProperties& contacts, const std::vector<Stage>& stages) {
  const std::vector<double> unknown(static_cast<std::size_t>(blocks.n_blocks()), -1);
  std::vector<double> most = unknown;
  remove_later(stages, blocks);
  const bool wet = std::ranges::any_of(stages, [](const Stage& stage) { return stage.water.any(); });
  const std::vector<FacePart> faces = wet ? divide_faces(blocks) : std::vector<FacePart>();
  for (std::size_t s = 0; s < stages.size(); ++s) {
    change_blocks(stages[s], 0, faces, blocks);
    if (s > 0 && !loads_anew(stages[s], stages[s - 1])) continue;
    for (const Bolt& bolt : blocks.bolts)
      if (bolt.installed) install(bolt, blocks, initial);
    ContactBuilder builder(blocks, contacts);
    const FirstLoading loading = load_once(blocks, initial, builder);
    if (!loading.settled) return unknown;
    const std::vector<double> missing = missing_bending(blocks, initial, loading);
    std::ranges::transform(most, missing, most.begin(), [](double a, double b) { return std::max(a, b); });
  }
  const std::vector<char> deformed = deformed_by_supports(blocks);
  for (std::size_t b = 0; b < most.size(); ++b)
    if (deformed[b]) most[b] = inf;
  return most;
}

}  // namespace ddacontact
