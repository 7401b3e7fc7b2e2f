/// \file Loads on an element as nodal forces, consistent: they do the work that the load does on any field of
/// the element.
///
/// Each function adds to f, 2n entries in the order of (u1 v1 u2 v2 ... un vn), so that loads add up. Forces
/// are per unit thickness.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

#include <functional>

namespace polyfem {

/// A vector that depends on the place.
using VectorField = std::function<Vec2(const Vec2& x)>;

/// Adds the integral of N^T b for a uniform body force b, N/m^3: (23).
void body_force(const TabulatedElement& element, const Vec2& b, VectorXd& f);

/// The same for a body force that depends on the place, by the element's rule.
void body_force(const TabulatedElement& element, const VectorField& b, VectorXd& f);

/// Adds a traction, N/m^2, along edge `edge` from vertex `edge` on, linear between the values at its first
/// and last point. Exact.
void edge_traction(const PointsRef& polygon, Index edge, const Vec2& first, const Vec2& last, VectorXd& f);

/// The same for any traction, by three Gauss points: exact up to degree 4 along the edge.
void edge_traction(const PointsRef& polygon, Index edge, const VectorField& traction, VectorXd& f);

/// Adds a force, N/m, at a point of the closed polygon: N(x)^T times it. Throws Error when x lies outside by
/// more than the round-off of its coordinates, or is not finite.
void point_load(const PointsRef& polygon, const Basis& basis, const Vec2& x, const Vec2& force, VectorXd& f);

/// Adds the forces of an initial stress, which is there when d = 0: minus the integral of B^T sigma0, (19).
/// An initial strain eps0 (thermal, say) is the initial stress -D eps0. `stress` is at the integration
/// points, 3 x q; a uniform one is sigma0.replicate(1, q).
void initial_stress(const TabulatedElement& element, const TensorsRef& stress, VectorXd& f);

}  // namespace polyfem
