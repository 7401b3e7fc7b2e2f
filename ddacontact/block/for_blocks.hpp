/// \file Loops over blocks that threads share, with the same result for any number of them.
#pragma once

#include <ddacontact/core/for_all.hpp>

#include <numeric>

namespace ddacontact {

/// Calls work(b) for b = 0 .. n_blocks - 1: what it writes must belong to block b alone.
void for_blocks(int n_blocks, const auto& work) {
  for_all(n_blocks, work);
}

/// The sum of value(b) over b = 0 .. n_blocks - 1, in that order.
double sum_over_blocks(int n_blocks, const auto& value) {
  VectorXd values(n_blocks);
  for_blocks(n_blocks, [&](int b) { values[b] = value(b); });
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace ddacontact
