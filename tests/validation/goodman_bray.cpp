/// \file A slope of columns that topple.
#include "chapters.hpp"

namespace validation {

void goodman_bray(Report&) {}

}  // namespace validation
