/// \file Whether one block on a slope slides or topples.
#include "chapters.hpp"

namespace validation {

void chart(Report&) {}

}  // namespace validation
