#include <tests/support/flush_joints.hpp>

#include <ddacontact/block/rigid_velocity.hpp>
#include <tests/support/scene_changes.hpp>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace support {

using namespace ddacontact;

namespace {

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Scene empty_scene(const JointedBlocks& blocks) {
  Scene scene;
  scene.analysis.time_step = blocks.time_step;
  scene.analysis.steps = static_cast<int>(std::lround(blocks.duration / blocks.time_step));
  scene.analysis.gravity = Vec2(0, -9.8);
  scene.analysis.block_model = blocks.model;
  scene.materials = {{"rock", 2500, blocks.young, 0.3}};
  scene.joints = {{"joint", blocks.friction_angle, 0, 0, std::nullopt}};
  scene.contact.normal_stiffness = 40 * blocks.young;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  return scene;
}

void add(Scene& scene, const Points& vertices, bool fixed, const Vec2& velocity = Vec2::Zero()) {
  BlockDescription block;
  block.vertices = vertices;
  block.fixed = fixed;
  block.velocity = velocity;
  block.model = scene.analysis.block_model;
  scene.blocks.push_back(block);
}

Points box(double x, double y, double width, double height) {
  Points p(2, 4);
  p << x, x + width, x + width, x,  //
      y, y, y + height, y + height;
  return p;
}

}  // namespace

Scene sliding_over_bricks(const BrickRow& row, const JointedBlocks& blocks) {
  Scene scene = empty_scene(blocks);
  constexpr double width = 0.5, height = 0.5;
  for (int k = 0; k < row.n_bricks; ++k)
    add(scene, box(k * (width + row.gap), -height + (k < 5 ? 0 : row.step_up), width, height), !row.free);
  if (row.free) {
    Material base = scene.materials.front();
    base.name = "base";
    scene.materials.push_back(base);
    scene.joints.push_back({"bed", 45, 0, 0, std::array{0, 1}});
    add(scene, box(-1, -height - 1, row.n_bricks * (width + row.gap) + 2, 1), true);
    scene.blocks.back().material = 1;
  }
  add(scene, box(row.start, 0, 1, 0.5), false, Vec2(row.speed, 0));
  return scene;
}

Scene on_a_crossed_plane(const CrossedPlane& plane, const JointedBlocks& blocks) {
  Scene scene = empty_scene(blocks);
  constexpr double thickness = 0.5, length = 1, crossings[] = {2, 2.7};
  const double lean = thickness / std::tan(radians(plane.crossing_angle));
  const double tops[] = {0, crossings[0], crossings[1], 6};
  for (int k = 0; k < 3; ++k) {
    Points p(2, 4);
    p << tops[k] - (k > 0 ? lean : 0), tops[k + 1] - (k < 2 ? lean : 0), tops[k + 1], tops[k],  //
        -thickness, -thickness, 0, 0;
    add(scene, p, true);
  }
  for (int k = plane.n_blocks; k > 0; --k)
    add(scene, box(crossings[0] + plane.corner - k * length, 0, length, 0.3), false);
  const Vec2 gravity = scene.analysis.gravity;
  scene = turned(scene, Eigen::Rotation2Dd(-radians(plane.dip)).toRotationMatrix());
  scene.analysis.gravity = gravity;
  return scene;
}

Scene over_a_shaft(double clearance, const JointedBlocks& blocks) {
  Scene scene = empty_scene(blocks);
  add(scene, box(-2, -3, 2, 3), true);
  add(scene, box(1 + clearance, -3, 2, 3), true);
  add(scene, box(clearance / 2, 0, 1, 0.5), false);
  return scene;
}

double final_speed(const Scene& scene, int block, const Vec2& direction) {
  const BuiltScene built = build(scene);
  Stepper& stepper = *built.stepper;
  for (int k = 0; k < scene.n_steps(); ++k)
    if (!stepper.step()) throw Error(stepper.stop_reason());
  return rigid_velocity(stepper.blocks().block(block), stepper.state(), stepper.state().velocity)
      .linear.dot(direction.normalized());
}

}  // namespace support
