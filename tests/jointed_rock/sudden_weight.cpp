#include "sudden_weight.hpp"

#include <ddacontact/scene/builder.hpp>
#include <tests/support/scene_changes.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace jointed_rock {

std::string name_of(Verdict verdict) {
  constexpr std::array names{"moves", "creeps", "rests", "stops"};
  return names[static_cast<std::size_t>(verdict)];
}

Outcome let_go(Scene scene, double friction, double acceleration, double enough) {
  scene.joints[0].friction_angle = std::atan(friction) * 180 / std::numbers::pi;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = static_cast<int>(std::lround(watched / time_step));
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  const double way = acceleration * watched * watched / 2;
  Outcome outcome;
  bool stopped = false;
  for (int k = 0; k < scene.analysis.steps && outcome.displacement < enough * way && !stopped; ++k) {
    stopped = !stepper.step();
    outcome.displacement = stepper.blocks().displacements(stepper.state()).colwise().norm().maxCoeff();
  }
  outcome.time = stepper.state().time;
  if (outcome.time > 0)
    outcome.part = outcome.displacement / (acceleration * outcome.time * outcome.time / 2);
  outcome.vertices = support::vertex_displacements(built);
  if (stopped)
    outcome.verdict = Verdict::stops;
  else if (outcome.displacement >= moving_part * way)
    outcome.verdict = Verdict::moves;
  else
    outcome.verdict = outcome.displacement >= 0.1 * moving_part * way ? Verdict::creeps : Verdict::rests;
  return outcome;
}

}  // namespace jointed_rock
