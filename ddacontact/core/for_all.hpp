/// \file Loops that threads share, with the same result for any number of them.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/core/parallel.hpp>

namespace ddacontact {

/// Calls work(k) for k = 0 .. n - 1: what it writes must belong to k alone. Short loops take less time than
/// threads to meet.
void for_all(Index n, const auto& work) {
  constexpr Index grain = 64, shortest_shared = 1024;
  polyfem::for_ranges(n, n < shortest_shared ? shortest_shared : grain, [&](Index begin, Index end) {
    for (Index k = begin; k < end; ++k) work(k);
  });
}

}  // namespace ddacontact
