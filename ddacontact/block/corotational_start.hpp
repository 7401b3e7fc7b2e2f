/// \file What a corotational block keeps of the start of its step.
#pragma once

#include <ddacontact/block/step_matrices.hpp>
#include <ddacontact/core/types.hpp>

#include <memory>
#include <vector>

namespace ddacontact {

/// Rule and length of the step, and numbers that BlockMotion or CorotationalStep finds at its start and lays
/// out here: one array, as every awake block has one.
struct CorotationalStart {
  std::shared_ptr<const StepMatrices> matrices;
  std::vector<Vec2> arrays;
};

}  // namespace ddacontact
