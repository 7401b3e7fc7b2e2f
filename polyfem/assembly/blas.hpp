/// \file Which BLAS is in use, held to one thread, and the memory that it takes.
#pragma once

#include <cstddef>
#include <string>

namespace polyfem {

/// Limits OpenBLAS to one thread (more would change the last bits of results with their number) and returns
/// its description with the processor core it chose kernels for; "unknown (slow?)" for another BLAS.
std::string pin_blas_to_one_thread();

/// Throws OutOfMemory where there is no room for the buffer that OpenBLAS takes at its first call and keeps,
/// and for so many bytes beside it: it would ask for its buffer for ever. To be called before that call;
/// later calls cost nothing.
void expect_room_for_blas(std::size_t beside);

}  // namespace polyfem
