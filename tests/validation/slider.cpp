#include "slider.hpp"

#include <ddacontact/block/corotational_shape.hpp>

#include <Eigen/Eigenvalues>

#include <cmath>

namespace validation {

namespace {

constexpr double settling_friction = 89;  // degrees
constexpr int settling_steps = 20;

}  // namespace

Vec2 Slider::down() const {
  return {std::cos(angle), -std::sin(angle)};
}

Vec2 Slider::up() const {
  return {std::sin(angle), std::cos(angle)};
}

double Slider::acceleration() const {
  return gravity * (std::sin(angle) - std::cos(angle) * friction);
}

Scene slider_scene(const Slider& slider) {
  Scene scene = rock_scene(slider.time_step,
                           static_cast<int>(std::lround(slider.duration / slider.time_step)), slider.young);
  scene.materials[0].density = slider_density;
  scene.analysis.scheme = slider.scheme;
  if (slider.damping > 0)
    scene.analysis.damping.stiffness =
        2 * slider.damping / vibration(slider_width, slider_height, scene.materials[0]).first;
  scene.blocks = {block(turned(rectangle(-20, -1, 80, 1), -slider.angle), true),
                  block(turned(rectangle(0, 0, slider_width, slider_height), -slider.angle))};
  scene.joints[0].friction_angle = std::atan(slider.friction) * 360 / turn;
  scene.contact.normal_stiffness = slider.penalty * slider.young;
  scene.contact.tangential_stiffness = scene.contact.normal_stiffness / 2.5;
  return scene;
}

Vibration vibration(double width, double height, const Material& material) {
  const Points outline = rectangle(-width / 2, -height / 2, width, height);
  const CorotationalShape shape =
      polygon_shape({polyfem::elasticity_matrix(material.young, material.poisson, polyfem::Plane::strain),
                     material.density},
                    outline, polyfem::wachspress, choose_integration(outline, GradientCorrection::on));
  const ShapeCell& cell = shape.cells.front();
  Vibration vibration{MatrixXd::Zero(8, 8), cell.elastic.stiffness()};
  for (Index a = 0; a < 4; ++a)
    for (Index b = 0; b < 4; ++b)
      vibration.mass.block<2, 2>(2 * a, 2 * b) = cell.mass(a, b) * Mat2::Identity();
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(vibration.stiffness, vibration.mass);
  vibration.first = std::sqrt(modes.eigenvalues()[3]);  // after three rigid motions
  return vibration;
}

BuiltScene settled(Scene scene) {
  StageDescription settling = scene.stage("settling");
  settling.analysis.mode = Mode::statics;
  settling.analysis.scheme =
      scene.analysis.kinematics == Kinematics::incremental
          ? Scheme::backward_euler
          : Scheme::decaying;  // by midpoint static steps alternate about the equilibrium
  settling.analysis.time_step = settling_time / settling_steps;
  settling.analysis.steps = settling_steps;
  for (Joint& joint : settling.joints) joint.friction_angle = settling_friction;
  scene.stages = {settling, scene.stage("let go")};
  BuiltScene built = build(scene);
  run(*built.stepper, settling_steps);
  return built;
}

Travel run_slider(const Slider& slider, Stepper& stepper) {
  const double start = travel(stepper, 1).dot(slider.down());
  run(stepper, static_cast<int>(std::lround(slider.duration / slider.time_step)));
  return {travel(stepper, 1).dot(slider.down()) - start, velocity(stepper, 1).dot(slider.down())};
}

}  // namespace validation
