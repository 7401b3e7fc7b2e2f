/// \file The choice between the library's bases, by the polygon.
#pragma once

#include <polyfem/basis/basis.hpp>

namespace polyfem {

/// The sine of the turn from which on Wachspress functions are chosen. At a corner that turns by less they
/// are steep in a small place only: their energy is 0.8 / turn of that of mean value functions (4 times at
/// this turn, 370 times at 2e-3), and rules of fixed points do not see it (7 points a triangle: 59 % at this
/// turn, 11 % at 0.05, 3e-5 at 2e-3).
inline constexpr double least_wachspress_turn = 0.2;

/// `wachspress` where every corner turns left by more than `least_wachspress_turn`, `mean_value` where one is
/// straighter or concave. Six points a triangle give every deformation of a regular polygon of up to eight
/// vertices at least half of its energy then; where an edge is shorter than a thirtieth of the cell, with
/// more vertices and in deep notches a fifth or less: see `tabulate_to_tolerance` and `examine`.
const Basis& suitable_basis(const PointsRef& polygon);

}  // namespace polyfem
