/// \file Small scenes of the default mechanics, and one block of them made ready for a step.
#pragma once

#include <doc/verification/mechanics_scenes.hpp>

namespace stability {

using namespace ddacontact;

using verification::block;
using verification::gravity;
using verification::rectangle;
using verification::rock_scene;
using verification::turned;

/// Blocks upon each other on a held floor: squares of 1 m, friction 30 degrees.
Scene stack_scene(int blocks, double time_step, int steps);

/// A scene's blocks at the start of a step of `dt`, for what is asked of them beside any run.
class StartedBlocks {
 public:
  StartedBlocks(const Scene& scene, double dt);
  const Block& block(int b) const { return built_.stepper->blocks().block(b); }
  /// The forces by which block b resists displacements of its unknowns from its starting shape, N per m.
  VectorXd elastic_force(int b, const VectorXd& d) const;

 private:
  BuiltScene built_;
  StepStart start_;
};

/// States of all contacts, in their order.
std::vector<ContactState> states(const Stepper& stepper);

}  // namespace stability
