/// \file How long steps by central differences may be.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/core/options.hpp>

#include <optional>

namespace ddacontact {

/// The longest substep by central differences, and what limits it.
struct StableStep {
  double dt;        ///< s
  double critical;  ///< the critical step that it follows from, with a margin, s
  int block;        ///< whose that is
  int n_decaying;   ///< slivers: blocks of a critical step below dt, that decay as in Scheme::decaying
};

/// For the blocks that may move, see critical_step. A few slivers do not make all others slow: the limit is
/// the smallest critical step that is no sliver's. None: the steps of the analysis are not explicit.
std::optional<StableStep> find_stable_step(const BlockSystem& blocks, const AnalysisOptions& analysis);

}  // namespace ddacontact
