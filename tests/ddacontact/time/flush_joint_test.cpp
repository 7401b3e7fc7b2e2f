// Blocks do not notice flush joints, and fall into shafts of their own width; more on the page "jointed
// rock".
#include <tests/support/flush_joints.hpp>
#include <tests/support/scene_changes.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

using namespace ddacontact;
using namespace support;

namespace {

int last_block(const Scene& scene) {
  return static_cast<int>(scene.blocks.size()) - 1;
}

BlockDescription polygon(const std::vector<Vec2>& corners) {
  BlockDescription block;
  block.vertices.resize(2, static_cast<Index>(corners.size()));
  Index k = 0;
  for (const Vec2& corner : corners) block.vertices.col(k++) = corner;
  return block;
}

/// Smooth over ten bricks at 3 m/s: the speed after 0.6 s.
double speed_over(const BrickRow& row, double time_step) {
  const Scene scene = sliding_over_bricks(row, {.young = 1e9, .time_step = time_step, .duration = 0.6});
  return final_speed(scene, last_block(scene), Vec2(1, 0));
}

}  // namespace

TEST(FlushJoint, ABlockKeepsItsSpeedOverFixedBricks) {
  for (const double gap : {0.0, 1e-3})
    for (const double time_step : {1e-2, 1e-3})
      EXPECT_NEAR(speed_over({.gap = gap}, time_step), 3, 1e-6) << gap << " m, " << time_step << " s";
}

TEST(FlushJoint, ABlockKeepsItsSpeedOverFreeBricksThatSinkUnderIt) {
  for (const double gap : {0.0, 1e-3})
    for (const double time_step : {1e-2, 1e-3})
      EXPECT_NEAR(speed_over({.gap = gap, .free = true}, time_step), 3, 1e-3)
          << gap << " m, " << time_step << " s";
}

TEST(FlushJoint, FrictionIsThatOfOneFace) {
  const Scene scene = sliding_over_bricks(
      {.free = true}, {.young = 1e9, .friction_angle = 10, .time_step = 1e-3, .duration = 0.5});
  const double expected = 3 - 9.8 * std::tan(10 * std::numbers::pi / 180) * 0.5;
  EXPECT_NEAR(final_speed(scene, last_block(scene), Vec2(1, 0)), expected, 1e-3);
}

TEST(FlushJoint, ASlowBlockCrossesAJoint) {
  const Scene scene = sliding_over_bricks({.start = 0.999, .speed = 0.01},
                                          {.young = 1e9, .time_step = 1e-3, .duration = 0.3});
  EXPECT_NEAR(final_speed(scene, last_block(scene), Vec2(1, 0)), 0.01, 1e-7);
}

/// A corner climbs a step within the lip as it slides, in steps of any length: it goes up by a hundredth of its speed.
TEST(FlushJoint, AStepThatACornerPassesDoesNotThrowTheBlock) {
  constexpr double rise = 3e-5, speed = 3;
  for (const double time_step : {1e-6, 1e-5, 1e-4}) {
    const Scene scene =
        sliding_over_bricks({.step_up = rise, .start = 1.5 - speed * time_step / 2, .speed = speed},
                            {.time_step = time_step, .duration = 2e-3});
    const BuiltScene built = build(scene);
    const auto velocity = [&] {
      return rigid_velocity(built.stepper->blocks().block(last_block(scene)), built.stepper->state(),
                            built.stepper->state().velocity)
          .linear;
    };
    double fastest = 0;
    for (int step = 0; step < scene.analysis.steps; ++step) {
      ASSERT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
      fastest = std::max(fastest, velocity().y());
    }
    EXPECT_LT(fastest, 0.01 * speed) << time_step << " s";
    EXPECT_LT(built.stepper->energy().now.pushed_out, 1) << time_step << " s";
    EXPECT_NEAR(velocity().x(), speed, 1e-3) << time_step << " s";
  }
}

/// A step of a millimetre is no joint: the sharp corner stops at it.
TEST(FlushJoint, AStepStopsABlock) {
  EXPECT_LT(speed_over({.step_up = 1e-3, .start = 1.2}, 1e-3), 1.5);
}

TEST(FlushJoint, ACornerAtACrossingDoesNotHoldABlock) {
  for (const double dip : {20.0, 60.0})
    for (const double corner : {-1e-9, 0.0, 1e-6})
      for (const double crossing : {60.0, 90.0, 120.0}) {
        const Scene scene = on_a_crossed_plane({.dip = dip, .crossing_angle = crossing, .corner = corner},
                                               {.time_step = 1e-3, .duration = 0.1});
        const double angle = dip * std::numbers::pi / 180, expected = 9.8 * std::sin(angle) * 0.1;
        EXPECT_NEAR(final_speed(scene, 3, Vec2(std::cos(angle), -std::sin(angle))), expected, 0.01 * expected)
            << dip << " degrees, crossing " << crossing << ", corner " << corner;
      }
}

TEST(FlushJoint, ABlockFallsIntoAShaftOfItsOwnWidth) {
  const Mat2 mirror = Vec2(-1, 1).asDiagonal();
  for (const double clearance : {0.0, 1e-9, 1e-6})
    for (const double time_step : {1e-2, 1e-3}) {
      const Scene scene = over_a_shaft(clearance, {.time_step = time_step, .duration = 0.3});
      // What touches in the step after the last takes up to half of what gravity gives in a step.
      const double tolerance = 3e-3 + 9.8 * time_step / 2;
      EXPECT_NEAR(final_speed(scene, 2, Vec2(0, -1)), 2.94, tolerance) << clearance;
      EXPECT_NEAR(final_speed(turned(scene, mirror), 2, Vec2(0, -1)), 2.94, tolerance) << clearance;
      EXPECT_NEAR(final_speed(reordered(scene, {2, 1, 0}), 0, Vec2(0, -1)), 2.94, tolerance) << clearance;
    }
}

/// A shaft a tenth of a millimetre narrower carries it.
TEST(FlushJoint, ABlockOverANarrowerShaftStays) {
  const Scene scene = over_a_shaft(-3e-4, {.time_step = 1e-3, .duration = 0.1});
  EXPECT_NEAR(final_speed(scene, 2, Vec2(0, -1)), 0, 1e-3);
}

/// Two fixed blocks with a flush top, and a slider of 3 m/s with a friction angle of 10 degrees. Vertices a
/// millimetre from a corner, one on the side of the joint and one on the front of the slider, are collinear
/// with their sides: no block turns far enough in a step for such an edge to meet what the corner passes.
TEST(FlushJoint, ShortEdgesBesideCornersHoldNothing) {
  struct Case {
    std::vector<Vec2> behind, before, slider;
  };
  const Case hidden{{{-1, -1}, {1.57, -1}, {1.57, 0}, {-1, 0}},
                    {{1.57, -1}, {8, -1}, {8, 0}, {1.57, 0}, {1.57, -1e-3}},
                    {{0, 0}, {1, 0}, {1.2, 0.5}, {0, 0.5}}},
      on_the_slider{{{-1, -1}, {1.27, -1}, {1.57, 0}, {-1, 0}},
                    {{1.27, -1}, {8, -1}, {8, 0}, {1.57, 0}},
                    {{0, 0}, {1, 0}, {1, 1e-3}, {1, 0.5}, {0, 0.5}}};
  const Mat2 mirror = Vec2(-1, 1).asDiagonal();
  for (const Case& of : {hidden, on_the_slider})
    for (const double time_step : {2e-2, 1e-2, 2e-3})
      for (const bool mirrored : {false, true}) {
        Scene scene;
        scene.materials = {{"rock", 2500, 35e9, 0.2}};
        scene.joints = {{"joint", 10, 0, 0, std::nullopt}};
        scene.contact.normal_stiffness = scene.contact.tangential_stiffness = 40 * 35e9;
        scene.analysis.time_step = time_step;
        scene.analysis.steps = static_cast<int>(std::lround(0.5 / time_step));
        for (const std::vector<Vec2>& corners : {of.behind, of.before, of.slider}) {
          scene.blocks.push_back(polygon(corners));
          scene.blocks.back().model = BlockModel::mean_value;
        }
        scene.blocks[0].fixed = scene.blocks[1].fixed = true;
        scene.blocks[2].velocity = {3, 0};
        if (mirrored) scene = turned(scene, mirror);
        const double expected = 3 - 9.8 * std::tan(10 * std::numbers::pi / 180) * 0.5;
        EXPECT_NEAR(final_speed(scene, 2, Vec2(mirrored ? -1 : 1, 0)), expected, 1e-6) << time_step;
      }
}

/// A smooth wedge between a plane of 50 degrees and nothing, its toe on level ground. Where plane and ground
/// are two blocks, their corners at the seam below the toe hold it no more than one block does: there is no
/// equilibrium.
TEST(FlushJoint, CornersAtASeamBelowAToeHoldNothing) {
  const Mat2 mirror = Vec2(-1, 1).asDiagonal();
  for (const Mode mode : {Mode::statics, Mode::dynamic})
    for (const bool mirrored : {false, true}) {
      Scene scene;
      scene.materials = {{"stone", 2000, 20e9, 0.2}};
      scene.joints = {{"joint", 0, 0, 0, std::nullopt}};
      scene.contact.normal_stiffness = 40 * 20e9;
      scene.contact.tangential_stiffness = 16 * 20e9;
      scene.analysis.mode = mode;
      scene.analysis.time_step = 0.01;
      scene.analysis.steps = 20;
      scene.analysis.max_displacement_ratio = 1;
      scene.blocks = {polygon({{-8, -1}, {0, -1}, {0, 0}, {-8, 0}}),
                      polygon({{0, -1}, {12, -1}, {12, 3}, {2.5, 3}, {0, 0}}),
                      polygon({{0, 0}, {2.5, 3}, {0, 3}})};
      scene.blocks[0].fixed = scene.blocks[1].fixed = true;
      if (mirrored) scene = turned(scene, mirror);
      const BuiltScene built = build(scene);
      for (int step = 0; step < scene.analysis.steps; ++step)
        ASSERT_TRUE(built.stepper->step()) << built.stepper->stop_reason();
      EXPECT_FALSE(built.stepper->equilibrium().in_balance());
      EXPECT_GT(built.stepper->blocks().displacements(built.stepper->state()).colwise().norm().maxCoeff(),
                1e-3);
    }
}
