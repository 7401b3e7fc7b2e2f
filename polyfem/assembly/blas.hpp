/// \file Which BLAS is in use, held to one thread.
#pragma once

#include <string>

namespace polyfem {

/// Limits OpenBLAS to one thread (more would change the last bits of results with their number) and returns
/// its description with the processor core it chose kernels for; "unknown (slow?)" for another BLAS.
std::string pin_blas_to_one_thread();

}  // namespace polyfem
