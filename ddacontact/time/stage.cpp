#include <ddacontact/time/stage.hpp>

namespace ddacontact {

void remove_later(const std::vector<Stage>& stages, BlockSystem& blocks) {
  for (const Stage& stage : stages) {
    for (int b : stage.added) blocks.remove(b);
    for (int bolt : stage.bolts) blocks.bolts[bolt].installed = false;
  }
}

void change_blocks(const Stage& stage, double start_time, const std::vector<FacePart>& faces,
                   BlockSystem& blocks) {
  blocks.gravity = stage.analysis.gravity;
  for (int b : stage.removed) blocks.remove(b);
  for (int b : stage.added) blocks.restore(b, start_time);
  const auto bring = [&](const auto& load, int block, TimeFunction& function, auto& to) {
    function.start = start_time;
    if (blocks.is_present(block)) to.push_back(load);
  };
  for (PointLoad load : stage.point_loads) bring(load, load.point.block, load.force, blocks.point_loads);
  for (PressureLoad load : stage.pressure_loads)
    bring(load, load.block, load.pressure, blocks.pressure_loads);
  for (BodyLoad load : stage.body_loads) bring(load, load.block, load.force, blocks.body_loads);
  blocks.water = {stage.water, stage.water.any() ? present_faces(blocks, faces) : std::vector<WetFace>()};
  for (int bolt : stage.bolts) blocks.bolts[bolt].installed = true;
}

}  // namespace ddacontact
