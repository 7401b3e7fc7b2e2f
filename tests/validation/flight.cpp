/// \file Free fall, a projectile and a spinning block.
#include "chapters.hpp"

namespace validation {

void flight(Report&) {}

}  // namespace validation
