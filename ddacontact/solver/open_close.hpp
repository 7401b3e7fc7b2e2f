/// \file Open-close iteration: contact states that agree with the displacements they lead to.
#pragma once

#include <ddacontact/solver/step_system.hpp>

namespace ddacontact {

struct OpenCloseOptions {
  int max_iterations = 40;            ///< solutions of (13) per try
  double residual_tolerance = 1e-8;   ///< of the residual's scale
};

enum class OpenCloseStatus {
  settled,            ///< every state agrees and the residual passes
  friction_unsettled, ///< open and closed agree; stick and slip, or the size of friction, do not
  unsettled,          ///< some contact is open that should be closed, or closed that should be open
  not_positive_definite,
  not_finite
};

struct OpenCloseReport {
  OpenCloseStatus status = OpenCloseStatus::unsettled;
  int iterations = 0;
  Residual residual;                  ///< at the end, for the states the contacts are left with
  int last_changed = -1;              ///< a contact whose state changed in the last iteration, -1: none
};

/// Starting from the contacts' states and d = the prescribed displacements, solves (13) and adapts the states
/// until they agree with the solution ("surmised and calculated contact state are consistent", section 4.3)
/// and the residual, with friction taken from the present penetration, is below tolerance. Each pass corrects
/// d by K^-1 times the true residual, so that round-off of the factor does not stay in d. Leaves the states
/// in `contacts` and sets their `was_closed`.
OpenCloseReport iterate_open_close(StepSystem& system, const OpenCloseOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d);

}  // namespace ddacontact
