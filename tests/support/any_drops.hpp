/// \file Drops of random polygons of any shape into closed boxes, and whether anything passed through
/// anything.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <cstdint>
#include <string>

namespace support {

/// What the blocks fall on; all of it held, in a closed box.
enum class Ground {
  floor,    ///< level
  ramp,     ///< a wedge on the floor
  notches,  ///< a floor with rectangular slots and V-shaped ones
  vessel    ///< a thick concave vessel with slanting inner sides
};
inline constexpr int n_grounds = 4;
std::string name_of(Ground ground);

/// Seed s is of ground s modulo `n_grounds`. Two to six simple polygons of sizes 1:30, convex and concave,
/// some with vertices on straight edges; random velocities and spins; friction 0..45 degrees, restitution
/// 0..0.5, E of 1e8..1e10 Pa, steps of 2e-3..1e-2 s. One block in seven is affine, others are single cells of
/// Wachspress or mean value functions.
Ground ground_of(std::uint64_t seed);
ddacontact::Scene any_drop(std::uint64_t seed);

/// What became of a drop.
struct AnyDrop {
  long blocks = 0, steps = 0, substeps = 0, rejected = 0, overlap_rejections = 0, rises = 0;
  double overlap = 0;      ///< largest common area of two blocks, relative to the smaller one, after any step
  double rise = 0;         ///< largest gain of mechanical energy in a step, relative to the largest kinetic
  bool passed = false;     ///< a block's centre was outside the box, or all of it in another block
  std::string failure;     ///< when and where blocks passed or overlapped by more than `overlap_limit`
  std::string stopped_by;  ///< why the run stopped; empty: it did not
};
inline constexpr double overlap_limit = 1e-4;
/// Mechanical energy that grows in a step by more than this part of the largest kinetic energy is counted.
inline constexpr double energy_rise = 1e-6;

AnyDrop run_any_drop(std::uint64_t seed);

}  // namespace support
