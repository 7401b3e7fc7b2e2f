/// \file How deep blocks may overlap where they come in, at the start or with a stage.
#pragma once

namespace ddacontact {

/// An overlap deeper than this times the size of a pair of blocks is refused.
inline constexpr double deepest_overlap = 1e-3;

}  // namespace ddacontact
