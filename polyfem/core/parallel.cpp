#include <polyfem/core/parallel.hpp>

#include <omp.h>

#include <algorithm>
#include <exception>
#include <limits>

namespace polyfem {

namespace {

thread_local int threads = 1;

}  // namespace

void set_threads(int n) {
  threads = std::max(n, 1);
}

int n_threads() {
  return threads;
}

void for_ranges(Index n, Index grain, const std::function<void(Index, Index)>& work) {
  const Index n_pieces = (n + grain - 1) / grain;
  if (n_pieces <= 1 || threads == 1 || omp_in_parallel()) {
    for (Index begin = 0; begin < n; begin += grain) work(begin, std::min(begin + grain, n));
    return;
  }
  std::exception_ptr thrown;
  Index thrown_by = std::numeric_limits<Index>::max();
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (Index piece = 0; piece < n_pieces; ++piece) {
    try {
      work(piece * grain, std::min((piece + 1) * grain, n));
    } catch (...) {
#pragma omp critical
      if (piece < thrown_by) {
        thrown_by = piece;
        thrown = std::current_exception();
      }
    }
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace polyfem
