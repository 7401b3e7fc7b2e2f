/// \file Work that is shared among threads, with the same result for any number of them.
#pragma once

#include <polyfem/core/types.hpp>

#include <functional>

namespace polyfem {

/// How many threads `for_ranges` may use from now on, in the calling thread; 1 until this is called. What is
/// < 1 counts as 1.
void set_threads(int n);
/// How many that is.
int n_threads();

/// Calls work(begin, end) for 0 .. n - 1 in pieces of `grain`, each piece once, in any order and by any
/// thread: what the work writes must belong to its piece alone. Pieces do not depend on the number of
/// threads. Within `work` no further threads are used. An exception of the work is thrown on, of the first
/// piece that threw one.
void for_ranges(Index n, Index grain, const std::function<void(Index begin, Index end)>& work);

}  // namespace polyfem
