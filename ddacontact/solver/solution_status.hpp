/// \file How the solution of a step ended.
#pragma once

namespace ddacontact {

/// Whether the step may be accepted; if it is not settled, it is cut.
enum class SolutionStatus {
  settled,             ///< the residual passes, states agree, penetration is below its tolerance
  friction_unsettled,  ///< open and closed agree; stick and slip, or the size of friction, do not
  states_unsettled,    ///< some contact is open that should be closed, or closed that should be open
  forces_unsettled,    ///< the residual does not pass
  penetrating,         ///< the residual passes, penetration stays above its tolerance
  not_positive_definite,
  not_finite
};

}  // namespace ddacontact
