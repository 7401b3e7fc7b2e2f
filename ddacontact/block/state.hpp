/// \file Everything that changes from step to step, in a few contiguous arrays.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// The blocks' part of the state. A step writes a second one; a rejected step keeps the old.
struct BlockState {
  double time = 0;
  Points position;    ///< outline vertices of all blocks, relative to the model's origin
  VectorXd velocity;  ///< of every unknown
  Tensors stress;     ///< at the integration points of all blocks
  VectorXd rotation;  ///< of each block since the start: best fit, not wrapped, radians
};

}  // namespace ddacontact
