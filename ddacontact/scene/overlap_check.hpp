/// \file Blocks that overlap too deeply at the start.
#pragma once

#include <ddacontact/core/deepest_overlap.hpp>
#include <ddacontact/scene/names.hpp>
#include <ddacontact/scene/outline_check.hpp>

#include <limits>
#include <vector>

namespace ddacontact::scene_format {

/// What the check needs of each block.
struct PositionedOutline {
  CheckedOutline outline;
  bool held = false;  ///< in x and y at every vertex; two held blocks may overlap
  SourceLocation location;
  /// The stages with which it comes in and is taken out; negative, and beyond all, where it always is there.
  int comes = -1, goes = std::numeric_limits<int>::max();

  bool meets(const PositionedOutline& other) const { return comes < other.goes && other.comes < goes; }
};

/// The size of a pair, m: that of the smaller block, held blocks not counted.
double size_of_pair(const PositionedOutline& a, const PositionedOutline& b);

/// A problem for each pair of valid blocks that overlap deeply and are there at the same time; after 1000 of
/// them it says so and stops. Returns whether there is none.
bool check_overlaps(const std::vector<PositionedOutline>& blocks, const NameTable& names,
                    ProblemList& problems);

}  // namespace ddacontact::scene_format
