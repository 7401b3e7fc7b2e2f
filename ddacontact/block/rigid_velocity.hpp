/// \file The rigid part of a block's motion.
#pragma once

#include <ddacontact/block/block.hpp>

namespace ddacontact {

/// A block's momentum over its mass, and its angular momentum about the centroid over its inertia.
struct RigidVelocity {
  Vec2 linear;         ///< m/s
  double angular = 0;  ///< rad/s
};

/// \param[in] state     where the block is
/// \param[in] velocity  of all unknowns of the system
RigidVelocity rigid_velocity(const Block& block, const BlockState& state, const VectorXd& velocity);
/// \param[in] momenta  of the block's own unknowns: forces make accelerations so
RigidVelocity rigid_velocity_by(const Block& block, const BlockState& state, const VectorIn& momenta);
/// Velocities of the block's own unknowns in this rigid motion.
VectorXd as_velocity(const Block& block, const BlockState& state, const RigidVelocity& rigid);

}  // namespace ddacontact
