/// \file Everything that changes from step to step, in a few contiguous arrays.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// The blocks' part of the state. A step writes a second one; a rejected step keeps the old.
///
/// A block's state is an origin near it and points relative to that, so that gaps and strains are as
/// exact as the block is small, wherever it is. Origins are multiples of a power of two of about the block's
/// size: their differences are exact, and so is moving one after its block.
struct BlockState {
  /// Coordinates of a block as a rigid body: two of its centre of mass, and its angle.
  static constexpr int n_rigid = 3;

  double time = 0;
  Points origin;    ///< of each block, relative to the model's origin
  Points position;  ///< the points of all blocks, relative to their block's origin
  /// Coordinates of the blocks that are carried on by their motions, from which points follow: centre of mass
  /// from the origin, angle, deformation of the nodes (MotionShape). Empty: the points are the state.
  VectorXd coordinates;
  VectorXd velocity;  ///< of every unknown
  /// History that the scheme carries on beside the velocity, of every unknown: Newmark's the acceleration at
  /// the end of the last step; with half steps the velocity in the middle of that step, on the present shape.
  VectorXd carried;
  /// Length of the step that `carried` is of, s; 0: none, the next step begins with the velocity itself.
  double carried_dt = 0;
  /// The velocity that a dynamic step goes on with.
  const VectorXd& going_on() const { return carried_dt > 0 ? carried : velocity; }
  Tensors stress;  ///< at the integration points of all blocks: the stress (incremental blocks), or what the
                   ///< reference shape has of it, in the block's own frame (corotational blocks); empty where
                   ///< no block has or ever gets any
  VectorXd rotation;  ///< of each block since the start: best fit, not wrapped, radians
  VectorXd bolts;     ///< histories of all bolts, see Bolt::numbers
};

}  // namespace ddacontact
