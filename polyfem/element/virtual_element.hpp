/// \file Virtual elements of lowest order: no shape functions and no rule, polygons of any simple shape.
///
/// Functions are linear on edges and unknown inside. Of them the linear function nearest in energy, the
/// projection P v = mean of v at the vertices + mean gradient (x - mean vertex), is known from the boundary
/// alone; the energy of the rest is replaced by a multiple of its values at the vertices (Beirao da Veiga,
/// Brezzi and Marini, SIAM J. Numer. Anal. 51, 2013; Gain, Talischi and Paulino, CMAME 282, 2014).
/// Unknowns, units and order are those of `stiffness`, so that `FieldProblem` takes either. Polygons are
/// counter-clockwise and of nonzero area.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// K = |E| B^T D B + s (1 - P)^T (1 - P), 2n x 2n, overwritten: B takes nodal values to the mean strain, 3 x
/// 2n, P to the values of their projection at the vertices (rotations included), and s = |E| tr D / tr(C^T C)
/// with the columns of C the three unit strains as displacements of the vertices. Exact for linear fields; on
/// triangles it is `stiffness`. D is symmetric; near incompressibility this element locks as `stiffness`
/// does.
void virtual_stiffness(const PointsRef& polygon, const Mat3& elasticity, MatrixXd& K);

/// The projections P N_i of the functions of the vertices and their gradients, which are constant, as a table
/// for loads, masses, strains, `stress_field` and error norms: at the centroid, where one point suffices for
/// the element's order. `stiffness` of it is K without the energy of the rest, which is singular.
void tabulate_virtual(const PointsRef& polygon, TabulatedElement& element);

/// The same at the points of a triangle rule on each triangle of the polygon, see `make_polygon_rule`.
void tabulate_virtual(const PointsRef& polygon, const TriangleRule& triangle_rule, TabulatedElement& element);

}  // namespace polyfem
