/// \file A block on a plane, let go after it has settled.
#pragma once

#include <mechanics_scenes.hpp>
#include <report.hpp>

#include <fmt/format.h>

#include <string>

namespace validation {

using namespace verification;

/// A block of 3 x 1.5 m, 2600 kg/m3, on a plane that falls to the right; the rest is as rock_scene has it.
struct Slider {
  double angle = 0;     ///< of the plane, radians
  double friction = 0;  ///< tan(phi)
  double time_step = 0.01;
  double duration = 1;  ///< s, after the block was let go
  double young = 35e9;  ///< Pa
  double damping = 0;   ///< of the block's first mode, proportional to its stiffness: the ratio to critical
  double penalty = 40;  ///< of E
  Scheme scheme = Scheme::decaying;

  Vec2 down() const;  ///< along the plane
  Vec2 up() const;    ///< across it, into the block
  /// Of the rigid block while it slides down, m/s2.
  double acceleration() const;
};

/// How long the static stage lasts, s.
constexpr double settling_time = 2;
constexpr double soft = 35e6;  ///< Young's modulus, Pa
inline std::string degrees_text(double angle) {
  return fmt::format("{:g}°", angle);
}
constexpr double slider_width = 3, slider_height = 1.5, slider_density = 2600;

/// Block 0 is the plane, 1 the slider.
Scene slider_scene(const Slider& slider);
/// The vibrations of a free rectangular block as one element has them.
struct Vibration {
  MatrixXd mass, stiffness;  ///< by the displacements x, y of the corners
  double first = 0;          ///< angular frequency of the lowest mode, rad/s
};
Vibration vibration(double width, double height, const Material& material);

/// The scene with a static stage before it in which friction is 89 degrees, at the end of that stage: at
/// rest, at `settling_time`.
BuiltScene settled(Scene scene);

/// Way and speed of the slider down the plane.
struct Travel {
  double way = 0, speed = 0;  ///< m, m/s
};
/// Runs the scene to its end from where `stepper` stands.
Travel run_slider(const Slider& slider, Stepper& stepper);

/// The part of the chapter on vibrations of soft sliders, against the eigenvalues of the equations.
void vibration_by_friction(Report& report);

}  // namespace validation
