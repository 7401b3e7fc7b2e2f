#include "mechanics_scenes.hpp"

#include <fmt/format.h>
#include <ddacontact/block/rigid_velocity.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

namespace verification {

Points rectangle(double x, double y, double width, double height) {
  Points p(2, 4);
  p << x, x + width, x + width, x,  //
      y, y, y + height, y + height;
  return p;
}

Points turned(const Points& polygon, double angle) {
  return Eigen::Rotation2Dd(angle).toRotationMatrix() * polygon;
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Points pentagon() {
  Points p(2, 5);
  p << 0, 2, 2.5, 1, -0.3,  //
      0, 0, 1.2, 2, 1;
  return p;
}

BlockDescription block(const Points& vertices, bool fixed) {
  BlockDescription description;
  description.vertices = vertices;
  description.fixed = fixed;
  return description;
}

void set_default_springs(Scene& scene) {
  double stiffest = 0;
  for (const Material& material : scene.materials) stiffest = std::max(stiffest, material.young);
  scene.contact.normal_stiffness = 40 * stiffest;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
}

Scene rock_scene(double time_step, int steps, double young) {
  Scene scene;
  scene.analysis.time_step = time_step;
  scene.analysis.steps = steps;
  scene.analysis.kinematics = Kinematics::corotational;
  scene.analysis.scheme = Scheme::decaying;
  scene.analysis.cutting_factor = 0.5;
  scene.analysis.max_displacement_ratio = 10;
  scene.contact.method = ContactMethod::staged;
  scene.contact.penetration_tolerance = 1e-6;
  scene.materials = {{"rock", 2500, young, 0.3}};
  scene.joints.resize(1);
  set_default_springs(scene);
  return scene;
}

void run(Stepper& stepper, int steps) {
  for (int k = 0; k < steps; ++k)
    if (!stepper.step()) throw Error(fmt::format("at {} s: {}", stepper.state().time, stepper.stop_reason()));
}

BuiltScene run(const Scene& scene) {
  BuiltScene built = build(scene);
  run(*built.stepper, scene.n_steps());
  return built;
}

double angular_momentum(const Stepper& stepper, int b) {
  const Block& block = stepper.blocks().block(b);
  const VectorXd turning = block.rotation(stepper.state());
  return turning.dot(block.mass() * turning) * angular_velocity(stepper, b);
}

Momenta momenta(const Stepper& stepper) {
  Momenta sum;
  for (int b = 0; b < stepper.blocks().n_blocks(); ++b) {
    if (!stepper.blocks().is_movable(b)) continue;
    const Block& of = stepper.blocks().block(b);
    const Vec2 mv = of.mass_total() * velocity(stepper, b), x = of.centroid(stepper.state());
    sum.linear += mv;
    sum.sum_of_moduli += mv.norm();
    sum.angular += x.x() * mv.y() - x.y() * mv.x() + angular_momentum(stepper, b);
  }
  return sum;
}

double mechanical_energy(const Stepper& stepper) {
  const Energy& now = stepper.energy().now;
  return now.kinetic + now.elastic + now.gravity;
}

Vec2 travel(const Stepper& stepper, int b) {
  const Block& of = stepper.blocks().block(b);
  return of.centroid(stepper.state()) - polyfem::area_moments(of.reference()).centroid;
}

Vec2 velocity(const Stepper& stepper, int b) {
  return rigid_velocity(stepper.blocks().block(b), stepper.state(), stepper.state().velocity).linear;
}

double angular_velocity(const Stepper& stepper, int b) {
  return rigid_velocity(stepper.blocks().block(b), stepper.state(), stepper.state().velocity).angular;
}

double normal_force_between(const Stepper& stepper, int one, int other) {
  double sum = 0;
  for (const ContactRecord& contact : stepper.contacts()) {
    const auto [low, high] = std::minmax(contact.pair.vertex_block, contact.pair.edge_block);
    if (low == std::min(one, other) && high == std::max(one, other)) sum += contact.normal;
  }
  return sum;
}

std::string text(double value) {
  const double size = std::abs(value);
  return size != 0 && (size < 1e-3 || size >= 1e5) ? fmt::format("{:.1e}", value)
                                                   : fmt::format("{:.3g}", value);
}

double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace verification
