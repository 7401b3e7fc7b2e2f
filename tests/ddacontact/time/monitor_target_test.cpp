#include <ddacontact/time/monitor_target.hpp>
#include <tests/ddacontact/simple_scenes.hpp>

#include <gtest/gtest.h>

using namespace support;

/// In flight without gravity, turning: its centre moves on a line, and points about it.
TEST(MonitorTarget, TellsWhereAPointIsWhereItWasAndHowFastItGoes) {
  Scene scene = rock_scene(0.01, 5);
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = Scheme::midpoint;
  scene.analysis.gravity.setZero();
  scene.materials[0].young = 1e12;
  scene.blocks = {block(rectangle(-9, 0, 1, 1)), block(rectangle(3, 1, 2, 1))};
  scene.blocks[1].velocity = {2, -1};
  scene.blocks[1].angular_velocity = 3;
  const BuiltScene built = run(scene);
  const Stepper& stepper = *built.stepper;
  const Block& of = stepper.blocks().block(1);
  const MonitorTarget centre{"", Centroid{1}}, corner{"", MaterialPoint{1, VectorXd::Unit(4, 2)}};
  EXPECT_EQ(centre.block(), 1);
  EXPECT_EQ(corner.block(), 1);
  const Vec2 start = polyfem::area_moments(of.reference()).centroid, way = 0.05 * Vec2(2, -1);
  const Motion middle = observe(centre, stepper), end = observe(corner, stepper);
  EXPECT_LE((middle.position - start - way).norm(), 1e-9);
  EXPECT_LE((middle.displacement - way).norm(), 1e-9);
  EXPECT_LE((middle.velocity - Vec2(2, -1)).norm(), 1e-9);
  const Vec2 arm = Eigen::Rotation2Dd(0.15) * Vec2(1, 0.5);
  EXPECT_LE((end.position - middle.position - arm).norm(), 1e-3);
  EXPECT_LE((end.displacement - way - (arm - Vec2(1, 0.5))).norm(), 1e-3);
  EXPECT_LE((end.velocity - Vec2(2, -1) - 3 * Vec2(-arm.y(), arm.x())).norm(), 2e-2);
}
