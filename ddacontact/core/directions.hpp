/// \file Of which shape the directions of forces are.
#pragma once

namespace ddacontact {

/// Of which place the derivatives are that forces act by: of the start or the end of a motion, or the
/// discrete gradients of both.
enum class Directions { of_start, mean, of_end };

}  // namespace ddacontact
