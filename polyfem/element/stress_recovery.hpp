/// \file Strains of an element where no integration point is; stress is D times them.
///
/// At the integration points `strains` (or `b_bar_strains`) gives them. From there two ways lead to the
/// vertices: the linear field nearest to the values at the points, and the gradients of the shape functions
/// at the vertices themselves. The first is the one to use with B-bar, and before averages over the cells
/// around a vertex.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

namespace polyfem {

/// The strain B(x) d at any point of the closed polygon, by the basis as it is, without the gradient
/// correction.
Vec3 strain_at(const PointsRef& polygon, const Basis& basis, const Eigen::Ref<const VectorXd>& d,
               const Vec2& x);

/// The strains B d at all vertices, 3 x n, likewise.
void vertex_strains(const PointsRef& polygon, const Basis& basis, const Eigen::Ref<const VectorXd>& d,
                    Tensors& strain);

/// Values at the vertices (k x n) of the linear fields nearest to values at the integration points (k x q),
/// in the mean square by the element's rule. Exact for linear fields when the rule is of degree 2 or finer.
void extrapolate_to_vertices(const PointsRef& polygon, const TabulatedElement& element,
                             const Eigen::Ref<const MatrixXd>& at_points, MatrixXd& at_vertices);

}  // namespace polyfem
