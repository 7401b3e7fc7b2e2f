/// \file A wedge between two planes.
#include "chapters.hpp"

namespace validation {

void wedge(Report&) {}

}  // namespace validation
