/// \file Scenes drawn by lot that are hard on contacts: blocks of sizes 1:30 that fall, collide, slide and
/// spin.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <cstdint>
#include <string>

namespace support {

/// What a drawn scene is of.
enum class DropKind {
  floor,    ///< blocks thrown onto a level floor
  ramp,     ///< onto a slope
  wedge,    ///< between two slopes
  swarm,    ///< at each other, without gravity
  wall,     ///< a brick wall hit by a block
  stack,    ///< a stack whose blocks begin to move
  pile,     ///< 30 blocks close together with random velocities
  arch,     ///< wedge-shaped blocks in a half ring
  assembly  ///< the cells of a rectangle, on a slope
};
inline constexpr int n_drop_kinds = 9;
std::string name_of(DropKind kind);

/// Seed s gives kind s modulo `n_drop_kinds`; friction 0..1, restitution 0..1, E of 1e7..1e11 Pa, contact
/// springs of 1..1000 E, steps of 1e-3..2e-2 s, all at random.
DropKind drop_kind(std::uint64_t seed);
ddacontact::Scene random_drop(std::uint64_t seed);

}  // namespace support
