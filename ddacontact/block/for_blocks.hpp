/// \file Loops over blocks that threads share, with the same result for any number of them.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/core/parallel.hpp>

namespace ddacontact {

/// Calls work(b) for b = 0 .. n_blocks - 1: what it writes must belong to block b alone.
void for_blocks(int n_blocks, const auto& work) {
  constexpr Index grain = 64;
  polyfem::for_ranges(n_blocks, grain, [&](Index begin, Index end) {
    for (Index b = begin; b < end; ++b) work(static_cast<int>(b));
  });
}

/// The sum of value(b) over b = 0 .. n_blocks - 1, in that order.
double sum_over_blocks(int n_blocks, const auto& value) {
  VectorXd values(n_blocks);
  for_blocks(n_blocks, [&](int b) { values[b] = value(b); });
  double sum = 0;
  for (const double of_block : values) sum += of_block;
  return sum;
}

}  // namespace ddacontact
