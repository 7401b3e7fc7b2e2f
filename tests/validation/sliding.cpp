/// \file Blocks that slide, stiff and soft, after they settled.
#include "chapters.hpp"

namespace validation {

void sliding(Report&) {}

}  // namespace validation
