/// \file Plane elastic fields in closed form: what is computed is compared with them.
#pragma once

#include <polyfem/material/linear_elastic.hpp>

#include <functional>

namespace support {

/// An isotropic body, its displacements, the stresses (xx, yy, xy) they cause and the body force that
/// balances these.
struct ElasticSolution {
  double young = 1, poisson = 0.3;
  polyfem::Plane plane = polyfem::Plane::strain;
  std::function<polyfem::Vec2(const polyfem::Vec2&)> displacement;
  std::function<polyfem::Vec3(const polyfem::Vec2&)> stress;
  std::function<polyfem::Vec2(const polyfem::Vec2&)> body_force;  ///< empty: none
};

/// The force on a unit area with the outward unit normal n.
polyfem::Vec2 traction(const polyfem::Vec3& stress, const polyfem::Vec2& n);

/// Half a wave in the unit square, u = (sin pi x sin pi y, y^2 cos pi x); plane strain.
ElasticSolution manufactured_solution(double young, double poisson);

/// A beam 0 <= x <= length, |y| <= height / 2, carrying `force` upwards at its right end as a parabola of
/// shear; the point (0, 0) does not move and the axis is horizontal there. Plane strain. Timoshenko and
/// Goodier, section 21.
ElasticSolution cantilever_solution(double young, double poisson, double length, double height, double force);

/// An infinite plate with a circular hole about the origin, pulled along x by `tension` far away. Plane
/// strain. Kirsch (1898).
ElasticSolution hole_solution(double young, double poisson, double radius, double tension);

}  // namespace support
