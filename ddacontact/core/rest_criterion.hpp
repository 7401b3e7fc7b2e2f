/// \file When a stage may end before its steps are made.
#pragma once

#include <optional>

namespace ddacontact {

/// What must be slow enough, beside forces in balance; what is not set is not asked. In static steps the
/// velocity is that of the last substep: its displacements over its length.
struct RestCriterion {
  std::optional<double> kinetic;       ///< kinetic energy over the largest energy exchanged, at most
  std::optional<double> displacement;  ///< sizes of its block that any vertex moves in a second, at most

  bool operator==(const RestCriterion&) const = default;
};

}  // namespace ddacontact
