/// \file Limit analysis of rigid blocks that touch without tension, with friction: linear programs of the
/// static theorem.
///
/// Unknown are the forces at the contact points of `touching_faces`, N >= 0 and |T| <= mu N. They are
/// admissible when they and the loads balance on every free block: two forces, and the moment about its
/// centroid.
/// - Where no admissible forces exist the blocks move, whatever happens to them as they slide.
/// - Where admissible forces exist they rest if sliding dilates by the friction angle (associated flow). Real
///   joints dilate less: of mechanisms in which blocks slide, the limit is an upper bound. Without sliding it
///   is exact.
///
/// Where a corner touches a corner alone, as at a crossing of joints, there is no common tangent. The blocks
/// may pass each other on either side, so they move when no admissible forces exist for some choice of such
/// tangents. A tangent is chosen where the mechanism, which the dual of the program gives, would push one
/// corner into the other, and so that it hinders the mechanism least. Drucker (1954), Livesley (1978), Baggio
/// and Trovalusci (1998).
#pragma once

#include "touching_faces.hpp"

#include <ddacontact/scene/scene.hpp>

#include <optional>
#include <vector>

namespace support {

/// Forces on blocks, (x, y) in N per m and the moment about the centroid in N m per m, a block a column.
using BlockForces = Eigen::Matrix3Xd;

/// Rigid blocks as they stand, and what acts on them.
struct RigidBlocks {
  std::vector<bool> fixed;
  std::vector<Vec2> centroids;
  Touching touching;
  BlockForces dead;              ///< what does not change: the weight
  BlockForces live;              ///< what the load factor multiplies: the loads
  double length = 0, force = 0;  ///< the blocks' typical size, m, and weight, N per m: what is not zero
};

/// The blocks of a scene at its start: weights as dead load, point and body forces as live load (of a history
/// its first entry). Friction, cohesion, velocities and stages do not count. Throws ddacontact::Error for
/// pressures and for supports of single vertices.
RigidBlocks rigid_blocks(const ddacontact::Scene& scene);

/// The same blocks where no corner passes a corner: those that touch press on each other across every line
/// between them. Blocks interlock where one joint has slipped by a hair and the joints that cross it have
/// steps. Their least friction is the least with which admissible forces exist at all.
RigidBlocks interlocked(RigidBlocks blocks);

/// Admissible forces under the dead load alone.
/// \param[in] friction  mu = tan(phi), the same everywhere
bool can_be_held(const RigidBlocks& blocks, double friction);

/// The least mu at which the dead load can be held, to 1e-6 of it; 0: without friction; none: not at an angle
/// of 89 degrees either.
std::optional<double> least_friction(const RigidBlocks& blocks);

/// The largest lambda >= 0 at which dead + lambda live can be held, infinity included; none: there is none.
std::optional<double> largest_factor(const RigidBlocks& blocks, double friction);

}  // namespace support
