/// \file Criteria of impacts: which contacts bear a load before one, and which bonds hold in it.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/time/rigid_velocities.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

/// Speeds below this are no more than round-off, m/s.
inline double round_off_speed(const Contact& contact, double dt) {
  return negligible_gap * coincidence * contact.size / dt;
}

/// Whether a contact bears a load: it is closed and bonded, or its force exceeds round-off and a thousandth
/// of the lighter block's weight. One that only touches passes on the impulse that it gets.
inline bool bears(const BlockSystem& blocks, const Contact& contact, double dt) {
  constexpr double least_of_weight = 1e-3;
  if (!contact.closed() || contact.has_bond()) return contact.closed();
  const auto mass = [&](int b) { return blocks.is_movable(b) ? blocks.block(b).mass_total() : inf; };
  return contact.history.normal * dt >
         std::min(mass(contact.pair.vertex_block), mass(contact.pair.edge_block)) *
             std::max(least_of_weight * blocks.gravity.norm() * dt, round_off_speed(contact, dt));
}

/// Whether the bond of a contact has the strength to bear an impulse within `duration`, s.
inline bool bond_bears(const Contact& contact, const ImpactContact& part, const ContactImpulse& impulse,
                       double duration) {
  return -impulse.normal <= contact.law.tension * duration &&
         std::abs(impulse.shear) <=
             part.bound(std::max(0.0, impulse.normal)) + contact.law.cohesion * duration;
}

}  // namespace ddacontact
