/// \file What a user has to be told of how a run went.
#pragma once

#include <ddacontact/time/stepper.hpp>

#include <string>
#include <vector>

namespace ddacontact {

/// Warnings, a line each with its cure: stages whose `until` never came true, a last stage that is static and
/// ends out of balance, and what was seen on the way (RunWarnings).
std::vector<std::string> warnings_of(const Stepper& stepper);

}  // namespace ddacontact
