/// \file Arches and walls with a load that can be increased to their collapse, at random, the same for the
/// same seed.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <cstdint>
#include <string>

namespace support {

enum class Masonry {
  arch_point,    ///< an arch, a point load down on the middle of a voussoir's back
  arch_body,     ///< an arch, a horizontal body force
  running_bond,  ///< a brick wall on the ground, a horizontal body force
  stack_bond     ///< the same with joints from the top to the bottom
};
inline constexpr int n_masonry_kinds = 4;
std::string name_of(Masonry kind);

/// A structure that collapses without sliding, so that limit analysis is exact for it.
struct LoadedMasonry {
  ddacontact::Scene scene;  ///< loads as they are at the limit
  Masonry kind = Masonry::arch_point;
  double friction = 0;  ///< mu of all joints
};

/// Seed s is of kind s modulo `n_masonry_kinds`.
///
/// Arches of radius 5 m: 5 to 15 voussoirs between two fixed ones, opening of 90 to 180 degrees, thickness up
/// to 0.3 of the radius. Walls: 2 to 10 courses of 1 to 6 bricks of 1 x 0.5 m on a wide fixed block. Rock of
/// 2500 kg/m3 and 35 GPa; mu of 0.6 to 1. Drawn again until the structure carries its own weight, by a limit
/// that friction ten times as large does not raise by 0.1 %, and by a load between a twentieth of the weight
/// and the weight: more would bend stiff rock as well.
LoadedMasonry random_masonry(std::uint64_t seed);

/// The loads times `factor`: 1 is the limit.
ddacontact::Scene loaded(const LoadedMasonry& masonry, double factor);

}  // namespace support
