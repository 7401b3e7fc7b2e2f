// A smooth block that slides over a brink turns about it, and leaves it without a blow as its trailing corner passes.
#include <ddacontact/block/rigid_velocity.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

using namespace ddacontact;
using namespace support;

namespace {

constexpr double width = 1, height = 0.6, along_table = 0.854126278927, onto_table = -9.762708041299;
const double size = std::sqrt(width * height);

/// The block is `behind` the brink with its leading corner, on a table that slopes by 5 degrees.
Scene block_before_brink(double behind, double speed, double rounding, double time_step) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.gravity = {along_table, onto_table};
  scene.materials = {{"rock", 2500, 2e10, 0.2}};
  scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
  scene.contact.corner_rounding = rounding;
  scene.contact.normal_stiffness = 8e11;
  scene.contact.tangential_stiffness = 3.2e11;
  scene.blocks = {block(rectangle(-6, -1, 6, 1), true), block(rectangle(-behind - width, 0, width, height))};
  scene.blocks[1].velocity = {speed, 0};
  return scene;
}

/// Turning of a rigid block from where its centre is over the arc at the brink to where its trailing arc is, rad/s.
///
/// The arc bears on the lower face without friction: with a from there to the middle of the face, and the face at
/// the angle t, the force is what keeps the face on the arc.
double turning_at_departure(double behind, double speed, double rounding) {
  constexpr double inertia = (width * width + height * height) / 12, dt = 1e-5;
  const double radius = rounding * size, way = behind + width / 2 - radius;
  const Vec2 arc(-radius, -radius);
  Vec2 centre(-radius, height / 2), v(std::sqrt(speed * speed + 2 * along_table * way), 0);
  double angle = 0, turning = 0;
  const Vec2 gravity(along_table, onto_table);
  while (true) {
    const Vec2 t(std::cos(angle), std::sin(angle)), n(-t.y(), t.x());
    const double a = (arc - centre).dot(t);  // of where it bears along the face, from its middle
    if (a < radius - width / 2) return turning;
    const double bias = -turning * t.dot(v) + turning * (-t.dot(v) - turning * n.dot(centre - arc));
    const double force = std::max(0.0, (-n.dot(gravity) - bias) / (1 + a * a / inertia));
    v += dt * (gravity + force * n);
    turning += dt * force * a / inertia;
    centre += dt * v;
    angle += dt * turning;
  }
}

}  // namespace

TEST(Brink, ABlockLeavesItWithoutABlowWhereverItsCornerIsWithinTheStep) {
  constexpr double speed = 4;
  for (const auto& [rounding, time_step] : {std::pair{0., 5e-4}, {0., 2e-4}, {0.003, 2e-4}, {0.03, 2e-4}})
    for (const double behind : {1.0, 1.0137, 1.0274}) {
      const BuiltScene built = build(block_before_brink(behind, speed, rounding, time_step));
      const Stepper& stepper = *built.stepper;
      const auto trailing = [&] { return stepper.state().position(0, 4) + stepper.state().origin(0, 1); };
      const double start = trailing(), beyond_brink = behind + width + 0.03;
      while (trailing() - start < beyond_brink) ASSERT_TRUE(built.stepper->step()) << stepper.stop_reason();
      const Energy& energy = stepper.energy().now;
      const double turning =
          rigid_velocity(stepper.blocks().block(1), stepper.state(), stepper.state().velocity).angular;
      const double expected = turning_at_departure(behind, speed, rounding);
      const std::string which = std::to_string(behind) + " m, " + std::to_string(time_step) +
                                " s, rounded by " + std::to_string(rounding);
      EXPECT_NEAR(turning, expected, 0.01 * std::abs(expected)) << which;
      EXPECT_LT(energy.numerical_dissipated + energy.damping_dissipated, 0.1) << which;
    }
}
