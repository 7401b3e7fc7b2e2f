// A joint law of one's own: rough joints that are steep under small normal forces and flat under large ones.
//
//   T |        ___---     Patton's law: asperities are overridden at the angle phi + i up to the
//     |   __---           normal force N0, beyond it they are sheared off and phi alone is left
//     |  /                (forces per contact and metre):
//     | /                     T(N) = N tan(phi + i)                         for N <= N0,
//     |/________ N            T(N) = N0 tan(phi + i) + (N - N0) tan(phi)    beyond.
//        N0
//
// On a slope between phi and phi + i a light block rests. A heavy one, with both its contacts beyond N0,
// slides with a = g (sin a - cos a tan(phi)) - 2 N0 (tan(phi + i) - tan(phi)) / m.
#include <ddacontact/block/rigid_velocity.hpp>
#include <ddacontact/classic/vertex_block.hpp>
#include <ddacontact/time/stepper.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

using namespace ddacontact;

constexpr double degree = std::numbers::pi / 180, g = 9.8, slope = 35 * degree, young = 35e9;
const double steep = std::tan(40 * degree), flat = std::tan(25 * degree);
constexpr double N0 = 10e3;

double patton(double N) {
  return N <= N0 ? N * steep : N0 * steep + (N - N0) * flat;
}

/// The velocity down the slope, after half a second, of a block of 4 x 1 m and this mass per metre.
double velocity_after_half_a_second(double mass) {
  const BlockMaterial rock{polyfem::elasticity_matrix(young, 0.3, Plane::strain), mass / 4};
  const Vec2 down(std::cos(slope), -std::sin(slope)), up(std::sin(slope), std::cos(slope));
  const auto rectangle = [&](double begin, double end, double low, double high) {
    Points corners(2, 4);
    corners << begin * down + low * up, end * down + low * up, end * down + high * up,
        begin * down + high * up;
    return corners;
  };
  std::vector<std::unique_ptr<Block>> blocks;
  blocks.push_back(std::make_unique<VertexBlock>(rock, rectangle(-2, 20, -1, 0)));
  blocks.push_back(std::make_unique<VertexBlock>(rock, rectangle(0, 4, 0, 1)));
  BlockSystem system(std::move(blocks));
  std::vector<PrescribedDof> held;  // every vertex of the slope, in x and y
  for (int vertex = 0; vertex < 4; ++vertex)
    for (int axis = 0; axis < 2; ++axis) held.push_back({2 * vertex + axis, vertex, axis, {}});
  system.set_prescribed_dofs(held);

  const ContactProperties contacts{
      40 * young, 16 * young, JointTable(JointStrength{.friction_law = patton}), {0, 0}};
  AnalysisOptions analysis;
  analysis.gravity = Vec2(0, -g);
  analysis.scheme = Scheme::dda;
  analysis.kinematics = Kinematics::incremental;
  analysis.time_step = 0.01;
  BlockState start = system.initial_state();
  Stepper stepper(std::move(system), std::move(start), contacts, analysis);
  for (int k = 0; k < 50; ++k)
    if (!stepper.step()) throw Error(stepper.stop_reason());
  return rigid_velocity(stepper.blocks().block(1), stepper.state(), stepper.state().velocity)
      .linear.dot(down);
}

int main() {
  constexpr double light = 2e3, heavy = 20e3;
  const double exact =
      0.5 * (g * (std::sin(slope) - std::cos(slope) * flat) - 2 * N0 * (steep - flat) / heavy);
  const double resting = velocity_after_half_a_second(light), sliding = velocity_after_half_a_second(heavy);
  std::cout << "light: " << resting << " m/s, heavy: " << sliding << " m/s, expected " << exact << " m/s\n";
  return std::abs(resting) < 1e-4 && std::abs(sliding / exact - 1) < 1e-3 ? 0 : 1;
}
