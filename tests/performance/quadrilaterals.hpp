/// \file The same quadrilaterals for polyfem and for deal.II.
#pragma once

#include <polyfem/core/types.hpp>

#include <random>
#include <vector>

namespace performance {

/// 16 x 16 cells of a grid whose vertices are moved by up to a quarter of its step: general convex
/// quadrilaterals, counter-clockwise.
inline std::vector<polyfem::Points> perturbed_quadrilaterals() {
  constexpr int n = 16;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> move(-0.25, 0.25);
  polyfem::Points vertices(2, (n + 1) * (n + 1));
  for (int k = 0; k < (n + 1) * (n + 1); ++k) {
    const double x = k % (n + 1), y = k / (n + 1);  // integer division: the row
    vertices.col(k) << x + move(random), y + move(random);
  }
  std::vector<polyfem::Points> cells;
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const int first = row * (n + 1) + column;
      cells.push_back(vertices(Eigen::all, {first, first + 1, first + n + 2, first + n + 1}));
    }
  return cells;
}

}  // namespace performance
