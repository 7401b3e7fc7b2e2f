/// \file Janssen's silo.
#include "chapters.hpp"

namespace validation {

void silo(Report&) {}

}  // namespace validation
