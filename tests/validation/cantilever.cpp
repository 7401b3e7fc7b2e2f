/// \file A cantilever, and a cantilevered wall of blocks.
#include "chapters.hpp"

namespace validation {

void cantilever(Report&) {}

}  // namespace validation
