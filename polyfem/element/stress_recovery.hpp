/// \file Strains and stresses of an element where no integration point is.
///
/// At the integration points `strains` gives strains, stress is D times them, and `b_bar_stresses` gives the
/// stresses of that element.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// The strain B(x) d at any point of the closed polygon, by the basis as it is, without the gradient
/// correction.
Vec3 strain_at(const PointsRef& polygon, const Basis& basis, const Eigen::Ref<const VectorXd>& d,
               const Vec2& x);

/// Values at the vertices (k x n) of the linear fields nearest to values at the integration points (k x q),
/// in the mean square by the element's rule. Exact for linear fields when the rule is of degree 2 or finer,
/// however far from the origin.
/// In a direction in which the points lie together (to 1e-7 of the polygon's size) the fields are constant:
/// of a single point every vertex has the value.
///
/// On meshes of Voronoi cells, stresses taken to the vertices so have little more than half the error of
/// those of `strain_at` there; averaged over the cells around a vertex (`vertex_averages`), a quarter and
/// less.
void extrapolate_to_vertices(const PointsRef& polygon, const TabulatedElement& element,
                             const Eigen::Ref<const MatrixXd>& at_points, MatrixXd& at_vertices);

}  // namespace polyfem
