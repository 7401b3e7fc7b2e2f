/// \file Diagonals along which a simple polygon may be cut in two.
#pragma once

#include <polyfem/core/types.hpp>

#include <utility>
#include <vector>

namespace polyfem {

/// Whether the segment between the corners `start` and `end` of a simple counter-clockwise polygon leaves
/// both into the polygon and meets no other edge: then each side of it is a simple polygon. `corners` are
/// columns of `vertices`; `start` and `end` count in `corners`. Exact.
bool is_diagonal(const PointsRef& vertices, const std::vector<int>& corners, int start, int end);

/// The least sine of the four angles that a diagonal makes with the edges at its ends: what slivers have
/// small. Negative where one of them is beyond half a turn.
double least_diagonal_sine(const PointsRef& vertices, const std::vector<int>& corners, int start, int end);

/// The polygons on the two sides of a diagonal, that which begins with the lower of `start` and `end` first.
std::pair<std::vector<int>, std::vector<int>> split_at(const std::vector<int>& corners, int start, int end);

}  // namespace polyfem
