#include <ddacontact/scene/steep_water.hpp>

#include <ddacontact/core/quoted.hpp>
#include <ddacontact/scene/text.hpp>
#include <ddacontact/time/face_parts.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

constexpr double steep = 1;              ///< slope of a table; those of ground water are flatter
constexpr double way_of_failure = 0.02;  ///< sizes of the block, as TrialLimits::slip
constexpr double noted_change = 0.01;    ///< of the water on a block, over its weight

bool falls_steeply(const Points& table) {
  for (Index i = 1; i < table.cols(); ++i) {
    const Vec2 step = table.col(i) - table.col(i - 1);
    if (std::abs(step.y()) > steep * step.x()) return true;
  }
  return false;
}

}  // namespace

std::optional<std::string> note_on_steep_water(const BlockSystem& blocks, const BlockState& initial,
                                               const std::vector<Stage>& stages) {
  const auto steep_stage = std::ranges::find_if(stages, [](const Stage& stage) {
    return falls_steeply(stage.water.table) || falls_steeply(stage.water.joint_table);
  });
  if (steep_stage == stages.end()) return {};
  const Water& water = steep_stage->water;
  const Vec2& gravity = steep_stage->analysis.gravity;
  const Points positions = blocks.positions(initial);
  const std::vector<WetFace> faces = present_faces(blocks, divide_faces(blocks));
  const auto force_on = [&](int b, double shift) {
    const Range& v = blocks.block(b).vertices();
    const int n = blocks.block(b).n_vertices();
    const auto vertex = [&](int k) -> Vec2 { return positions.col(v.first + k % n) + Vec2(shift, 0); };
    Vec2 sum(0, 0);
    for (const WetFace& face : faces) {
      const Points& table = face.in_joint ? water.joint_table : water.table;
      if (face.block != b || table.cols() == 0) continue;
      const EdgeForces forces = water_forces(table, -water.density * gravity.y(), vertex(face.edge),
                                             vertex(face.edge + 1), face.from, face.to);
      sum += forces.start + forces.end;
    }
    return sum;
  };
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!blocks.is_movable(b)) continue;
    const double way = way_of_failure * blocks.block(b).size(),
                 weight = blocks.block(b).mass_total() * gravity.norm();
    const Vec2 now = force_on(b, 0);
    const double change = std::max((force_on(b, way) - now).norm(), (force_on(b, -way) - now).norm());
    if (change > noted_change * weight)
      return "the table of [water] falls steeply beside block " + quoted(blocks.names[b]) + ": " +
             scene_format::rounded(way) + " m to a side change the water on it by " +
             scene_format::rounded(100 * change / weight) +
             " % of its weight, before a factor of safety counts it as failed (let the table fall inside a "
             "block, further from its faces)";
  }
  return {};
}

}  // namespace ddacontact
