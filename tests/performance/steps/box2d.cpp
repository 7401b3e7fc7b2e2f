// Rigid walls by Box2D 2.4: what a step takes, and how far the wall sinks and leans.
//
//     box2d_performance FILE.csv [SIZE ...]      203 1040 10050 if none are given (sizes as of the
//                                                scene "wall")
//
// The bricks of the scene "wall" without rounding their corners, friction as there, no restitution, steps of
// 0.01 s with 8 and 3 iterations as Box2D recommends, sleeping switched off. Settling: the first steps;
// settled: those after two seconds.
#include <tests/performance/scenes.hpp>
#include <tests/performance/steps/clock.hpp>

#include <box2d/box2d.h>
#include <fmt/format.h>
#include <polyfem/core/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <numbers>
#include <vector>

namespace {

constexpr float time_step = 0.01F;
constexpr int velocity_iterations = 8, position_iterations = 3;
constexpr int settling_steps = 20, steps_to_rest = 200, settled_steps = 20;

/// A wall, and its bricks where they started.
struct Wall {
  b2World world{b2Vec2(0, -9.8F)};
  std::vector<b2Body*> bricks;
  std::vector<b2Vec2> starts;
};

void fill(const ddacontact::Scene& scene, Wall& wall) {
  wall.world.SetAllowSleeping(false);
  for (const ddacontact::BlockDescription& block : scene.blocks) {
    const Eigen::Vector2f low = block.vertices.rowwise().minCoeff().cast<float>(),
                          half = (block.vertices.rowwise().maxCoeff().cast<float>() - low) / 2;
    b2BodyDef body;
    body.type = block.fixed ? b2_staticBody : b2_dynamicBody;
    body.position.Set(low.x() + half.x(), low.y() + half.y());
    b2PolygonShape box;
    box.SetAsBox(half.x(), half.y());
    b2FixtureDef fixture;
    fixture.shape = &box;
    fixture.density = static_cast<float>(scene.materials[0].density);
    fixture.friction = static_cast<float>(std::tan(scene.joints[0].friction_angle * std::numbers::pi / 180));
    b2Body* const made = wall.world.CreateBody(&body);
    made->CreateFixture(&fixture);
    if (block.fixed) continue;
    wall.bricks.push_back(made);
    wall.starts.push_back(made->GetPosition());
  }
}

/// Median of processor time, s.
double step(Wall& wall, int n) {
  return step_performance::median_time(
      n, [&] { wall.world.Step(time_step, velocity_iterations, position_iterations); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: box2d_performance FILE.csv [SIZE ...]\n");
    return 2;
  }
  try {
    std::vector<int> sizes;
    for (int k = 2; k < argc; ++k) sizes.push_back(std::stoi(argv[k]));
    if (sizes.empty()) sizes = {200, 1000, 10000};
    std::ofstream file(argv[1]);
    file << "bricks,settling_s,settled_s,sunk_m,leaning_m,largest_speed\n";
    for (const int size : sizes) {
      Wall wall;
      fill(performance::brick_wall(size), wall);
      const double settling = step(wall, settling_steps);
      step(wall, steps_to_rest - settling_steps);
      const double settled = step(wall, settled_steps);
      float sunk = 0, leaning = 0, speed = 0;
      for (std::size_t k = 0; k < wall.bricks.size(); ++k) {
        const b2Vec2 moved = wall.bricks[k]->GetPosition() - wall.starts[k];
        sunk = std::max(sunk, -moved.y);
        leaning = std::max(leaning, std::abs(moved.x));
        speed = std::max(speed, wall.bricks[k]->GetLinearVelocity().Length());
      }
      const std::string line = fmt::format("{},{:.4g},{:.4g},{:.4g},{:.4g},{:.4g}", wall.bricks.size(),
                                           settling, settled, sunk, leaning, speed);
      file << line << '\n';
      fmt::print("{}\n", line);
      std::fflush(stdout);
    }
    file.close();
    if (!file) throw polyfem::Error(fmt::format("cannot write \"{}\"", argv[1]));
  } catch (const std::exception& error) {
    fmt::print(stderr, "box2d_performance: error: {}\n", error.what());
    return 1;
  }
  return 0;
}
