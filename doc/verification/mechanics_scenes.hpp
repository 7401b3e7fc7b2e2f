/// \file Small scenes filled in code, with the default mechanics, and what is measured of them.
#pragma once

#include <ddacontact/scene/builder.hpp>

#include <array>
#include <string>

namespace verification {

using namespace ddacontact;

constexpr double gravity = 9.8;  ///< m/s2
constexpr double turn = 6.283185307179586;

/// A time scheme as the pages call it.
struct NamedScheme {
  const char* name;
  Scheme scheme;
};
inline constexpr std::array schemes{
    NamedScheme{"decaying", Scheme::decaying}, NamedScheme{"midpoint", Scheme::midpoint},
    NamedScheme{"dda", Scheme::dda}, NamedScheme{"newmark (1/4, 1/2)", Scheme::newmark},
    NamedScheme{"backward_euler", Scheme::backward_euler}};

Points rectangle(double x, double y, double width, double height);
/// Counter-clockwise by `angle`, radians, about the origin.
Points turned(const Points& polygon, double angle);
double radians(double degrees);
/// A convex pentagon of 3.3 m2 without any symmetry.
Points pentagon();

BlockDescription block(const Points& vertices, bool fixed = false);
/// Rock (2500 kg/m3, 35 GPa, 0.3) without friction and without blocks, every option as a scene file has it by
/// default; blocks may move as far in a step as contact detection allows.
Scene rock_scene(double time_step, int steps, double young = 35e9);
/// The scene's springs as its stiffest material has them by default.
void set_default_springs(Scene& scene);

/// Throws Error when the run stops.
void run(Stepper& stepper, int steps);
BuiltScene run(const Scene& scene);
/// Processor time of `work`, s: the least of `tries`.
template <class Work>
double seconds_of(const Work& work, int tries = 1);

/// Sums over the blocks that are free.
struct Momenta {
  Vec2 linear{0, 0};
  double angular = 0;        ///< about the origin of the model
  double sum_of_moduli = 0;  ///< of the blocks' m |v|
};
Momenta momenta(const Stepper& stepper);
/// Of a block about its centre of mass, kg m2/s per m, and its inertia, kg m2 per m.
double angular_momentum(const Stepper& stepper, int block);
double inertia(const Block& block);
/// Kinetic, elastic and of gravity, J per m.
double mechanical_energy(const Stepper& stepper);
/// How far a block's centroid has come since the start, m.
Vec2 travel(const Stepper& stepper, int block);
Vec2 velocity(const Stepper& stepper, int block);
double angular_velocity(const Stepper& stepper, int block);
/// The normal forces between two blocks, N per m.
double normal_force_between(const Stepper& stepper, int one, int other);

/// A number in a table: three digits, small ones as 1.2e-05.
std::string text(double value);

double processor_time();  ///< of this process, s

template <class Work>
double seconds_of(const Work& work, int tries) {
  double least = 0;
  for (int k = 0; k < tries; ++k) {
    const double start = processor_time();
    work();
    const double took = processor_time() - start;
    if (k == 0 || took < least) least = took;
  }
  return least;
}

}  // namespace verification
