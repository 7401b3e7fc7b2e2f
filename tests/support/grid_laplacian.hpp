/// \file A symmetric matrix of any size.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

#include <vector>

namespace support {

/// The lower triangle of the five-point Laplacian on a square grid plus a multiple of the identity.
inline polyfem::SparseMatrix grid_laplacian(int side, double shift) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int k = y * side + x;
      entries.emplace_back(k, k, 4 + shift);
      if (x + 1 < side) entries.emplace_back(k + 1, k, -1);
      if (y + 1 < side) entries.emplace_back(k + side, k, -1);
    }
  polyfem::SparseMatrix lower(side * side, side * side);
  lower.setFromTriplets(entries.begin(), entries.end());
  return lower;
}

}  // namespace support
