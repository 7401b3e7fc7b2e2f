/// \file Normal gap and tangential slip of a vertex and an edge as affine forms, Eq. (33)-(45).
///
/// i is the vertex, j and k are the ends of the edge in the counter-clockwise order of its own block, n is
/// the outward normal and t the direction from j to k. Against the paper's signs: its d of (33) is positive
/// inside, our gap is -d, so that g < 0 is penetration and all coefficients of (37) are negated.
#pragma once

#include <ddacontact/contact/edge_motion.hpp>

namespace ddacontact {

/// g = -S0 / l - sum over i, j, k of (e g) . u, Eq. (33)-(37): first order in the step's displacements.
VertexEdgeForm gap_form(const VertexEdgePositions& start);

/// s = S0bar / l + t . (u_i - u_o), Eq. (41)-(45), with the lock point o = (1 - lock) x_j + lock x_k.
VertexEdgeForm slip_form(const VertexEdgePositions& start, double lock);

/// (x_i - x_j) . (x_k - x_j) / l^2: where the vertex projects onto the edge, 0 at j and 1 at k.
double edge_fraction(const Vec2& i, const Vec2& j, const Vec2& k);

}  // namespace ddacontact
