/// \file A rocking block.
#include "chapters.hpp"

namespace validation {

void rocking(Report&) {}

}  // namespace validation
