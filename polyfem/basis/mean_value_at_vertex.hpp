/// \file The mean value functions at a vertex, where they have no gradient.
#pragma once

#include <polyfem/basis/basis.hpp>

namespace polyfem {

/// A corner that turns by no more than this sine counts as straight: 1/turn would enter the linear functions
/// of its triangle.
inline constexpr double straight_turn = 1e-3;

/// Row `row` of the table at vertex j: the linear functions of its corner's triangle, and at a straight
/// corner the limit along the bisector.
///
/// With half the corner's angle phi, its bisector b, the normal b' of b towards vertex j + 1, and x counted
/// from vertex j, N_j+1 = w_j+1 h + (|x| + b'.x / sin phi) / (2 rho_j+1), N_j-1 likewise with -b', and the
/// others are N_i = w_i h, but for terms of order |x|^2. Here h = (b.x - |x| cos phi) / (2 sin phi), and w_i
/// are the weights at vertex j without the edges that end there.
void mean_value_at_vertex(const PointsRef& polygon, Index j, Index row, ShapeTable& table);

}  // namespace polyfem
