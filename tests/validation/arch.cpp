/// \file The least thickness of a semicircular arch.
#include "chapters.hpp"

namespace validation {

void arch(Report&) {}

}  // namespace validation
