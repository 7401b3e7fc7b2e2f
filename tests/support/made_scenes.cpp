#include "made_scenes.hpp"

#include "random_polygon.hpp"
#include "random_scenes.hpp"

#include <Eigen/Geometry>

namespace support {

namespace {

using namespace ddacontact;

Points box(double width, double height, const Vec2& corner = Vec2::Zero()) {
  Points p(2, 4);
  p << 0, width, width, 0, 0, 0, height, height;
  return p.colwise() + corner;
}

Points turned(const Points& polygon, double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix() * polygon;
}

BlockDescription block(const Points& outline, bool fixed = false) {
  BlockDescription b;
  b.vertices = outline;
  b.fixed = fixed;
  return b;
}

/// Options of a drop, rock of 10 GPa, a floor.
Scene scene_on_floor(double friction, double time_step) {
  Scene scene = random_drop(0);
  scene.analysis.time_step = time_step;
  scene.analysis.steps = 30;
  scene.materials = {{"rock", 2500, 1e10, 0.25}};
  scene.contact.normal_stiffness = 4e11;
  scene.contact.tangential_stiffness = 1.6e11;
  scene.joints[0] = {"joint", std::atan(friction) * 180 / std::numbers::pi, 0, 0, std::nullopt};
  scene.blocks = {block(box(40, 2, Vec2(-20, -2)), true)};
  return scene;
}

Scene fast_blocks(std::uint64_t seed) {
  Scene scene = random_drop(n_drop_kinds * seed + static_cast<std::uint64_t>(DropKind::pile));
  scene.analysis.time_step = 1e-2;
  scene.analysis.steps = 3;
  scene.contact.normal_stiffness = 40 * scene.materials[0].young;
  scene.contact.tangential_stiffness = 16 * scene.materials[0].young;
  scene.joints[0].friction_angle = 40;
  return scene;
}

Scene bonded_wall(double strength) {
  Scene scene = scene_on_floor(0.5, 5e-3);
  scene.joints[0].cohesion = strength;
  scene.joints[0].tensile_strength = strength / 2;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 2; ++column)
      scene.blocks.push_back(block(box(1, 0.5, Vec2(column, 0.5 * row))));
  scene.blocks.push_back(block(box(0.5, 0.5, Vec2(-0.52, 1.2))));
  scene.blocks.back().velocity = Vec2(8, 0);
  return scene;
}

/// A heavy or stiff block on a light or soft one.
Scene unequal_pair(double density_ratio, double stiffness_ratio) {
  Scene scene = scene_on_floor(0.5, 5e-3);
  scene.materials.push_back({"other", 2500 * density_ratio, 1e10 * stiffness_ratio, 0.25});
  scene.blocks.push_back(block(box(1, 1, Vec2(0, 0.001))));
  scene.blocks.push_back(block(box(1, 1, Vec2(0.2, 1.002))));
  scene.blocks.back().material = 1;
  return scene;
}

Scene slope_at_limit(double ratio) {
  const double angle = std::numbers::pi / 6;
  Scene scene = scene_on_floor(ratio * std::tan(angle), 1e-2);
  scene.blocks[0].vertices = turned(scene.blocks[0].vertices, angle);
  scene.blocks.push_back(block(turned(box(2, 1), angle)));
  return scene;
}

Scene corner_on_corner(double offset) {
  Scene scene = scene_on_floor(0.3, 1e-2);
  scene.blocks.push_back(block(box(1, 1)));
  scene.blocks.push_back(block(turned(box(1, 1), std::numbers::pi / 4).colwise() + Vec2(1 + offset, 1.01)));
  scene.blocks.back().velocity = Vec2(0, -2);
  return scene;
}

Scene rolling(int n, double speed) {
  Scene scene = scene_on_floor(0.8, 5e-3);
  const double inradius = 0.5 * std::cos(std::numbers::pi / n);
  scene.blocks.push_back(
      block(turned(0.5 * regular_polygon(n), std::numbers::pi / n - std::numbers::pi / 2).colwise() +
            Vec2(0, inradius)));
  scene.blocks.back().velocity = Vec2(speed, 0);
  scene.blocks.back().angular_velocity = -speed / inradius;
  return scene;
}

Scene spinning(double radians_a_step) {
  Scene scene = scene_on_floor(0.6, 1e-2);
  scene.analysis.max_displacement_ratio = 1;
  scene.blocks.push_back(block(turned(box(1, 0.6, Vec2(-0.5, 0.8)), 0.3)));
  scene.blocks.back().angular_velocity = radians_a_step / 1e-2;
  return scene;
}

Scene static_stack(double time_step, double friction) {
  Scene scene = scene_on_floor(friction, time_step);
  scene.analysis.mode = Mode::statics;
  scene.analysis.steps = 5;
  scene.analysis.scheme = Scheme::backward_euler;
  for (int k = 0; k < 6; ++k) scene.blocks.push_back(block(box(1, 0.5, Vec2(0.05 * k, 0.5 * k))));
  return scene;
}

}  // namespace

std::vector<std::pair<std::string, Scene>> made_scenes() {
  std::vector<std::pair<std::string, Scene>> scenes;
  for (std::uint64_t seed : {1, 2, 3, 4})
    scenes.emplace_back("fast_blocks_" + std::to_string(seed), fast_blocks(seed));
  for (double strength : {1e4, 1e5, 1e6})
    scenes.emplace_back("bonds_" + std::to_string(static_cast<int>(strength)), bonded_wall(strength));
  scenes.emplace_back("heavy_on_light", unequal_pair(1e6, 1));
  scenes.emplace_back("light_on_heavy", unequal_pair(1e-6, 1));
  scenes.emplace_back("stiff_on_soft", unequal_pair(1, 1e6));
  scenes.emplace_back("soft_on_stiff", unequal_pair(1, 1e-6));
  scenes.emplace_back("slope_stays", slope_at_limit(1 + 1e-6));
  scenes.emplace_back("slope_slides", slope_at_limit(1 - 1e-6));
  scenes.emplace_back("corner_on_corner", corner_on_corner(0));
  scenes.emplace_back("corner_beside_corner", corner_on_corner(1e-4));
  scenes.emplace_back("rolling_5", rolling(5, 2));
  scenes.emplace_back("rolling_8", rolling(8, 5));
  scenes.emplace_back("spinning_half", spinning(0.5));
  scenes.emplace_back("spinning_one", spinning(1));
  scenes.emplace_back("static_1", static_stack(1, 0.6));
  scenes.emplace_back("static_1000", static_stack(1e3, 0.6));
  return scenes;
}

}  // namespace support
