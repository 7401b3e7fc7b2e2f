/// \file A point of a block.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// A point that travels with its block: x = sum_p weights[p] * (point p of the block).
struct MaterialPoint {
  int block = 0;
  VectorXd weights;  ///< see Block::point_weights
};

}  // namespace ddacontact
