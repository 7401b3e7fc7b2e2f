/// \file A pressure wave along a bar of blocks.
#include "chapters.hpp"

namespace validation {

void wave(Report&) {}

}  // namespace validation
