/// \file Errors of an element's field against exact functions, squared, by the element's rule: summed over
/// the cells of a mesh they give the square of the norm.
///
/// The rule must be fine enough for the error that is measured, which is as a rule finer than the one solved
/// with: tabulate anew, without the gradient correction, to have the true gradients.
#pragma once

#include <polyfem/element/matrices.hpp>

#include <cassert>

namespace polyfem {

/// Integral of (u_h - u)^2 for one unknown a vertex; `exact` is called with a Vec2 and returns a number.
template <typename Exact>
double squared_error(const TabulatedElement& element, const Eigen::Ref<const VectorXd>& u,
                     const Exact& exact) {
  assert(u.size() == element.n_vertices());
  double sum = 0;
  for (Index q = 0; q < element.n_points(); ++q) {
    const double error = element.values.row(q).dot(u) - exact(Vec2(element.rule.points.col(q)));
    sum += element.rule.weights[q] * error * error;
  }
  return sum;
}

/// Integral of |u_h - u|^2 for displacements d in the order (u1 v1 u2 v2 ...); `exact` returns a Vec2.
template <typename Exact>
double squared_displacement_error(const TabulatedElement& element, const Eigen::Ref<const VectorXd>& d,
                                  const Exact& exact) {
  assert(d.size() == 2 * element.n_vertices());
  const Eigen::Map<const Points> vertices(d.data(), 2, element.n_vertices());
  double sum = 0;
  for (Index q = 0; q < element.n_points(); ++q) {
    const Vec2 u = vertices * element.values.row(q).transpose();
    sum += element.rule.weights[q] * (u - exact(Vec2(element.rule.points.col(q)))).squaredNorm();
  }
  return sum;
}

/// Integral of (grad u_h - grad u) . k (grad u_h - grad u) for one unknown a vertex; `exact` returns grad u.
template <typename Exact>
double squared_gradient_error(const TabulatedElement& element, const Mat2& conductivity,
                              const Eigen::Ref<const VectorXd>& u, const Exact& exact) {
  assert(u.size() == element.n_vertices());
  double sum = 0;
  for (Index q = 0; q < element.n_points(); ++q) {
    const Vec2 gradient(element.dx.row(q).dot(u), element.dy.row(q).dot(u));
    const Vec2 error = gradient - exact(Vec2(element.rule.points.col(q)));
    sum += element.rule.weights[q] * error.dot(conductivity * error);
  }
  return sum;
}

/// Integral of (eps_h - eps) . D (eps_h - eps) for strains at the integration points (3 x q), those of
/// `strains`; twice the energy of the error. `exact` returns (eps_xx, eps_yy,
/// gamma_xy).
template <typename Exact>
double squared_energy_error(const TabulatedElement& element, const Mat3& elasticity, const TensorsRef& strain,
                            const Exact& exact) {
  assert(strain.cols() == element.n_points());
  double sum = 0;
  for (Index q = 0; q < element.n_points(); ++q) {
    const Vec3 error = strain.col(q) - exact(Vec2(element.rule.points.col(q)));
    sum += element.rule.weights[q] * error.dot(elasticity * error);
  }
  return sum;
}

}  // namespace polyfem
