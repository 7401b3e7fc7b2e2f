/// \file Shape functions of a polygon at a point.
#pragma once

#include <polyfem/core/types.hpp>

namespace polyfem {

/// One entry a vertex, in the polygon's order.
struct ShapeValues {
  VectorXd values;   ///< N_i(x)
  Points gradients;  ///< grad N_i(x), one a column, in 1/length
};

/// A basis: fills `shape` for the polygon at x, reusing its storage.
using Basis = void (*)(const PointsRef& polygon, const Vec2& x, ShapeValues& shape);

}  // namespace polyfem
