/// \file Exact normal gap and slip of a vertex and an edge under motions of any size, and their derivatives.
///
/// With a = k - j, b = i - j, l = |a|, t = a / l and n = t turned clockwise, outward:
///     g = n . b,    s = t . b - lock l.
/// `contact/kinematics` has the paper's forms of first order. Of a touching vertex they have these gradients;
/// at a distance (36) leaves out the edge's stretch, -(g / l) t by k, and (44) the turning of t, (g / l) n by
/// k, and their opposites by j.
#pragma once

#include <ddacontact/block/point_map.hpp>
#include <ddacontact/core/directions.hpp>

namespace ddacontact {

/// Vertex i and the ends j, k of the edge, in the counter-clockwise order of the edge's own block. Only their
/// differences matter: coordinates near a common origin keep them exact. j and k must differ.
struct VertexEdgePositions {
  Vec2 i, j, k;
  Vec2 along() const { return (k - j).normalized(); }
  Vec2 outwards() const { return {along().y(), -along().x()}; }  ///< of the edge's block
};

/// Derivatives by the three positions: a force N along the gap is N times these. They sum to zero.
struct VertexEdgeGradient {
  Vec2 i, j, k;
  Vec2 after_i{0, 0};
};

/// -S0 / l of (33), (34), a length: the vertex's distance from the edge's line, < 0 is penetration.
double gap(const VertexEdgePositions& positions);

/// Gap and slip at the end of a motion, with the derivatives that forces there act by.
struct GapAndSlip {
  double gap;  ///< the start's and its change, which is good to the rounding of the motion
  double
      slip;  ///< (41): how far along the edge the vertex is from the lock point o = (1 - lock) j + lock k, m
  VertexEdgeGradient by_gap, by_slip;
};
/// For the motion `by` from `start`, the lock point staying where it is on the edge. Derivatives of the gap
/// are n by i, shared among j and k as the foot of the vertex divides the edge; those of the slip include the
/// turning and the stretch of the edge.
///
/// By Directions::mean they are discrete gradients, for forces whose work over the step is what their
/// potential loses: mean . (end - start) = gap(end) - gap(start) for any two positions, no net force, and no
/// moment about the configuration (start + end) / 2. The same from end to start. They differ from the
/// gradient there in second order; when all turn by D together it is the gradient turned by D / 2, times
/// cos(D / 2).
GapAndSlip gap_and_slip(const VertexEdgePositions& start, const VertexEdgePositions& by, double lock,
                        Directions directions);

/// constant + gradient.i . u_i + gradient.j . u_j + gradient.k . u_k: a gap or a slip as an affine function
/// of the displacements of the three points.
struct VertexEdgeForm {
  double constant = 0;
  VertexEdgeGradient gradient;
};

/// gradient.i . u_i + gradient.j . u_j + gradient.k . u_k
AffineForm gradient_form(const VertexEdgeGradient& gradient, const PointMap& i, const PointMap& j,
                         const PointMap& k);
/// Value of `gradient_form` at displacements d, to the bit.
double change_along(const VertexEdgeGradient& gradient, const PointMap& i, const PointMap& j,
                    const PointMap& k, const VectorXd& d);

}  // namespace ddacontact
