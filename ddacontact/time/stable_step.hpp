/// \file How long steps by central differences may be.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/core/options.hpp>

#include <optional>

namespace ddacontact {

/// The longest substep by central differences, and what limits it.
struct StableStep {
  double dt;        ///< s; time_step where that is shorter
  double critical;  ///< the critical step that limits it otherwise, s
  int block;        ///< the block of that step
  int n_decaying;   ///< slivers: blocks of a shorter critical step, that decay as in Scheme::decaying
};

/// For the blocks that may move, see longest_explicit_step. A few slivers do not make all others slow: they
/// are blocks whose critical step is below a quarter of that which a twentieth of the blocks is below. None:
/// the steps of the analysis are not explicit. Throws Error where damping leaves the block that limits
/// them less than a tenth of its step.
std::optional<StableStep> find_stable_step(const BlockSystem& blocks, const AnalysisOptions& analysis);

}  // namespace ddacontact
