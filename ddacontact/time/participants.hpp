/// \file The blocks that steps are made of.
#pragma once

#include <ddacontact/block/block_system.hpp>

namespace ddacontact {

/// The blocks that take part in steps, and their state: all of a run, or a part of them while the others sleep.
struct Participants {
  BlockSystem* blocks;
  BlockState* state;
};

}  // namespace ddacontact
