/// \file Blocks that overlap too deeply at the start.
#pragma once

#include <ddacontact/scene/names.hpp>
#include <ddacontact/scene/outline_check.hpp>

#include <vector>

namespace ddacontact::scene_format {

/// An overlap deeper than this times the size of a pair of blocks is refused.
inline constexpr double deepest_overlap = 1e-3;

/// What the check needs of each block.
struct PositionedOutline {
  CheckedOutline outline;
  bool held = false;  ///< in x and y at every vertex; two held blocks may overlap
  SourceLocation location;
};

/// The size of a pair, m: that of the smaller block, held blocks not counted.
double size_of_pair(const PositionedOutline& a, const PositionedOutline& b);

/// A problem for each pair of valid blocks that overlap deeply; after 1000 of them it says so and stops.
/// Returns whether there is none.
bool check_overlaps(const std::vector<PositionedOutline>& blocks, const NameTable& names,
                    ProblemList& problems);

}  // namespace ddacontact::scene_format
