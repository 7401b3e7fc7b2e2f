/// \file Criteria of impacts: which contacts bear a load before one, which corners pass, and which bonds hold in it.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/detection/corner.hpp>
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

/// Whether the vertex of an open contact, at a place near the end of its edge, is flush with the next one there: behind its line by no more
/// than the lip (ContactProperties::lip), and in front of it with both of its own sides. It passes, as in the solution
/// of a step.
inline bool passes_corner(const BlockSystem& blocks, const BlockState& state, const Contact& contact,
                          const VertexEdgePositions& at, double lip) {
  if (contact.closed() || lip == inf || contact.motion.rounding) return false;
  const PointsRef own = blocks.block(contact.pair.vertex_block).outline(state),
                  other = blocks.block(contact.pair.edge_block).outline(state);
  const int vertex = contact.pair.vertex, edge = contact.pair.edge;
  const bool at_end = (at.i - at.j).squaredNorm() > (at.i - at.k).squaredNorm();
  const int beside = at_end ? next(edge, other) : previous(edge, other);
  if (corner_at(other, at_end ? beside : edge) != Corner::convex) return false;
  const Vec2 side = along(other, beside).normalized(), outwards(side.y(), -side.x());
  const auto is_in_front = [&](const Vec2& to) { return outwards.dot(to) >= -sin_parallel * to.norm(); };
  return outwards.dot(at.i - (at_end ? at.k : at.j)) >= -lip * contact.size &&
         is_in_front(along(own, vertex)) && is_in_front(-along(own, previous(vertex, own)));
}

/// Whether the bond of a contact has the strength to bear an impulse within `duration`, s.
inline bool bond_bears(const Contact& contact, const ImpactContact& part, const ContactImpulse& impulse,
                       double duration) {
  return -impulse.normal <= contact.law.tension * duration &&
         std::abs(impulse.shear) <=
             part.bound(std::max(0.0, impulse.normal)) + contact.law.cohesion * duration;
}

}  // namespace ddacontact
