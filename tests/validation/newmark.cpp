/// \file Newmark's block on a shaken base.
#include "chapters.hpp"

namespace validation {

void newmark(Report&) {}

}  // namespace validation
