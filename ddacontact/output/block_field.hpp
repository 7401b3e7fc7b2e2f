/// \file Numbers of each block that frames hold. A new one is one entry of the table.
#pragma once

#include <ddacontact/time/stepper.hpp>

#include <vector>

namespace ddacontact {

/// A number of each block at the end of a step, of either sign. The files of frames, `dda plot` and Python have it
/// under its name, which is none of their other arrays'.
struct BlockField {
  const char* name;
  const char* unit;  ///< one that prefixes may stand before: rad, not kg
  double (*value)(const Stepper& stepper, int block);
};

/// All of them, in the order they are listed to users.
const std::vector<BlockField>& block_fields();

}  // namespace ddacontact
