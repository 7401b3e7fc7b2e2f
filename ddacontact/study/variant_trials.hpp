/// \file What a factor of safety rests on: trials of variants of the scene.
#pragma once

#include <ddacontact/study/strength_reduction.hpp>

#include <optional>
#include <vector>

namespace ddacontact {

/// A trial of the scene with rounded corners.
struct RoundedTrial {
  double rounding = 0;  ///< over the size of a block
  StrengthTrial trial;
};

/// What `dda safety` ends with.
struct VariantTrials {
  std::optional<RoundedTrial> rounded;
  std::optional<StrengthTrial> without_swelling;
};

/// Where joints cross, a slip by a hair makes steps that sharp corners do not pass. A mechanism that moves
/// with rounded corners at a factor well below the one at which it rests with sharp ones has found such
/// steps: the pivot that rounding moves inwards accounts for less than a hundredth.
///
/// Tries 95 % of the factor with corners rounded by 0.003, less of blocks with shorter edges. Nothing for
/// scenes whose corners are round already or cannot be; `stopped` where the scene with rounded corners does
/// not settle.
std::optional<RoundedTrial> try_with_rounded_corners(Scene scene, const std::vector<int>& joints,
                                                     double factor);

/// The strains of a block without a mesh are few: where it begins to topple, the load of its toe swells it
/// over its whole width (Poisson's effect), which presses its heel on a face beside it, and friction there
/// holds it. With a mesh the heel hardly swells, and the block topples.
///
/// Tries 95 % of the factor with Poisson's ratio 0. Nothing for scenes that have none.
std::optional<StrengthTrial> try_without_swelling(Scene scene, const std::vector<int>& joints, double factor);

}  // namespace ddacontact
