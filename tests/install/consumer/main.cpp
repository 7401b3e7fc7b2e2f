// Reads a scene, runs it and checks where its block falls to in 0.1 s.
#include "all_headers.hpp"

#include <cmath>
#include <iostream>

int main() {
  const char* const text = R"(format = 1
[analysis]
steps = 10
time_step = 0.01
gravity = [0.0, -10.0]
[[material]]
name = "rock"
density = 2500.0
young = "35 GPa"
poisson = 0.3
[[block]]
material = "rock"
vertices = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]
)";
  const ddacontact::SceneReading reading = ddacontact::read_scene_text(text, "falling");
  for (const ddacontact::Problem& problem : reading.problems) std::cerr << problem.text() << '\n';
  if (!reading.scene) return 1;
  const ddacontact::BuiltScene built = ddacontact::build(*reading.scene);
  for (int k = 0; k < reading.scene->analysis.steps; ++k)
    if (!built.stepper->step()) return 1;
  const Eigen::Vector2d centroid = built.stepper->blocks().block(0).centroid(built.stepper->state());
  std::cout << "centroid at " << centroid.transpose() << '\n';
  return std::abs(centroid.y() - 0.45) < 1e-12 ? 0 : 1;
}
