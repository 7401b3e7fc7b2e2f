/// \file What congruent corotational blocks share: nodes, matrices and maps of the reference shape.
#pragma once

#include <ddacontact/block/affine_block.hpp>
#include <ddacontact/block/vertex_block.hpp>
#include <polyfem/element/corotation.hpp>

namespace ddacontact {

/// A block's nodes are 2-vectors that turn with it; its unknowns are their changes in a step. For Wachspress
/// functions they are the outline's vertices. For Shi's affine displacements they are the centroid and the
/// two columns of F = dx/dX, times the block's size, which makes them lengths: six unknowns, linear in (1) at
/// any rotation.
struct CorotationalShape {
  Points nodes;                       ///< at rest, 2 x m, from the centroid of the outline
  polyfem::TabulatedElement element;  ///< functions of the m nodes at the integration points
  MatrixXd mass;                      ///< density * integral of N_a N_b, m x m
  VectorXd translation;               ///< of each node when the block is shifted by 1
  MatrixXd outline;                   ///< n x m: vertex i is at sum_a outline(i, a) y_a
  MatrixXd nodes_of_outline;  ///< m x n: the nodes of an outline, exact where the outline is one of theirs
  polyfem::CorotatedElement elastic;  ///< K of (17) and its frame
  /// Changes of the nodes by the unknowns, 2m x 2m; empty: they are the unknowns.
  MatrixXd basis;
};

/// Of a strictly convex, counter-clockwise outline.
CorotationalShape wachspress_shape(const BlockMaterial& material, const PointsRef& outline,
                                   const Integration& integration);

/// With control vertices their displacements are the unknowns (u v u v u v), so that holding one is leaving
/// out its unknowns.
CorotationalShape affine_shape(const BlockMaterial& material, const PointsRef& outline,
                               const std::optional<ControlVertices>& control = std::nullopt);

}  // namespace ddacontact
