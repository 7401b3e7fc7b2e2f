#include "solver_scenes.hpp"

namespace stability {

Scene stack_scene(int blocks, double time_step, int steps) {
  Scene scene = rock_scene(time_step, steps);
  scene.joints[0].friction_angle = 30;
  scene.blocks = {verification::block(rectangle(-2, -1, 5, 1), true)};
  for (int k = 0; k < blocks; ++k) scene.blocks.push_back(verification::block(rectangle(0, k, 1, 1)));
  return scene;
}

StartedBlocks::StartedBlocks(const Scene& scene, double dt) : built_(build(scene)) {
  const BlockState& state = built_.stepper->state();
  start_ = {{}, dt, state.velocity, state.carried};
  start_.rule.scheme = scene.analysis.scheme;
}

VectorXd StartedBlocks::elastic_force(int b, const VectorXd& d) const {
  std::unique_ptr<BlockStep> step;
  block(b).begin_step(built_.stepper->state(), start_, step);
  BlockForces forces;
  step->forces(d, forces);
  return forces.elastic();
}

std::vector<ContactState> states(const Stepper& stepper) {
  std::vector<ContactState> states;
  for (const ContactRecord& contact : stepper.contacts()) states.push_back(contact.history.state);
  return states;
}

}  // namespace stability
