/// \file Blocks that move on as rigid bodies, and the times at which approaching points touch.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/block/rigid_velocity.hpp>

#include <vector>

namespace ddacontact {

/// The first t in [0, dt] with g + v t + a t^2 / 2 <= 0; infinity: none.
double first_touch(double g, double v, double a, double dt);
/// The first t in [0, dt] at which a circle in straight motion touches a corner; infinity: none, also where
/// it passes by or moves away.
double first_touch(const Vec2& apart, const Vec2& velocity, double radius, double dt);

/// Deviation of a point from the straight line of its velocity as its block turns: R(angle) r - r - angle J
/// r.
///
/// \param[in] arm  r, from the centre of the block
Vec2 off_straight_line(const Vec2& arm, double angle);

/// The state of free blocks that go on as rigid bodies, each for its own time; infinity: it stays.
BlockState carried(const BlockSystem& blocks, const BlockState& state, const VectorXd& velocity,
                   const VectorXd& acceleration, const std::vector<double>& times);

/// Rigid velocity of every block.
std::vector<RigidVelocity> rigid_velocities(const BlockSystem& blocks, const BlockState& state,
                                            const VectorXd& velocity);

/// Turns the velocities of a free block's nodes about its centre; that of the centre stays.
void turn_about_centre(const Block& block, const BlockState& state, const Mat2& turn, VectorXd& velocity);

}  // namespace ddacontact
