/// \file Head-on and oblique collisions.
#include "chapters.hpp"

namespace validation {

void colliding(Report&) {}

}  // namespace validation
