/// \file How often a program asks for memory. To be linked into executables only.
#pragma once

namespace support {

/// Calls of malloc so far, in all threads, which operator new and matrices make too; -1 where a sanitizer has
/// replaced it.
long n_allocations();

}  // namespace support
