/// \file How often a program asks for memory. To be linked into executables only.
#pragma once

namespace step_performance {

/// Calls of malloc, calloc, realloc and what is made of them (operator new, matrices, CHOLMOD) so far, in all
/// threads; -1 where they are not counted because a sanitizer has replaced them.
long n_allocations();

}  // namespace step_performance
