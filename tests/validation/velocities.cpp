/// \file Sliding with and against an initial velocity.
#include "chapters.hpp"

namespace validation {

void velocities(Report&) {}

}  // namespace validation
