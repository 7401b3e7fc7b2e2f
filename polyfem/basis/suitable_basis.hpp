/// \file The choice between the library's bases, by the polygon.
#pragma once

#include <polyfem/basis/basis.hpp>

namespace polyfem {

/// `wachspress` where every corner turns left by more than the sine `straight_turn`, and so its functions are
/// good to round-off; `mean_value` where a corner is concave or straighter.
const Basis& suitable_basis(const PointsRef& polygon);

}  // namespace polyfem
