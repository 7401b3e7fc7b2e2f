// A block slides down a slope, by the library alone: no scene file, no program.
//
//   |\  /\       Example 5.1 of the paper. From rest, a rigid block on a slope of angle a with friction
//   | \/  \      angle phi has at time t the velocity
//   |  \  /         v = g t (sin a - cos a tan phi),   Eq. (53).
//   |   \/       It holds for blocks of hard rock (E = 35 GPa). Contact springs are 40 E along the normal
//   |____\ a     and 16 E along the edge, as scenes have them by default.
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <ddacontact/time/stepper.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace ddacontact;

int main() {
  constexpr double young = 35e9, g = 9.8, a = std::numbers::pi / 4, friction = 0.5;
  const BlockMaterial rock{polyfem::elasticity_matrix(young, 0.3, Plane::strain), 2500};

  Points ramp(2, 3), slider(2, 4);
  ramp << 0, 12, 0,  //
      0, 0, 12;
  slider << 1, 3, 4, 2,  //
      11, 9, 10, 12;
  std::vector<std::unique_ptr<Block>> blocks;
  for (const Points& outline : {ramp, slider}) blocks.push_back(std::make_unique<VertexBlock>(rock, outline));

  BlockSystem system(std::move(blocks));
  std::vector<PrescribedDof> held;  // every vertex of the ramp, in x and y
  for (int vertex = 0; vertex < 3; ++vertex)
    for (int axis = 0; axis < 2; ++axis) held.push_back({2 * vertex + axis, vertex, axis, {}});
  system.set_prescribed_dofs(held);

  const JointTable joints(JointStrength{.friction = friction});
  const ContactProperties contacts{40 * young, 16 * young, joints, {0, 0}};
  AnalysisOptions analysis;
  analysis.gravity = Vec2(0, -g);
  analysis.scheme = Scheme::dda;
  analysis.kinematics = Kinematics::incremental;
  analysis.time_step = 0.02;
  BlockState start = system.initial_state();
  Stepper stepper(std::move(system), std::move(start), contacts, analysis);
  for (int k = 0; k < 35; ++k) {
    if (stepper.step()) continue;
    std::cout << stepper.stop_reason() << '\n';
    return 1;
  }

  const Vec2 velocity =
      rigid_velocity(stepper.blocks().block(1), stepper.state(), stepper.state().velocity).linear;
  const double v = velocity.dot(Vec2(std::cos(a), -std::sin(a)));
  const double exact = g * stepper.state().time * (std::sin(a) - std::cos(a) * friction);
  std::cout << "after " << stepper.state().time << " s: " << v << " m/s, by (53) " << exact << " m/s\n";
  return std::abs(v / exact - 1) < 1e-4 ? 0 : 1;
}
