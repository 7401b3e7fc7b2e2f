/// \file An end-loaded cantilever with its exact solution.
#pragma once

#include <polyfem/core/types.hpp>
#include <polyfem/material/linear_elastic.hpp>

namespace support {

/// 0 <= x <= length, |y| <= height / 2, free above and below, in plane strain, under a downward force on the
/// end x = length, given by its parabolic shear stress (Timoshenko and Goodier).
struct Cantilever {
  double young = 1000, poisson = 0.3, force = 1;
  double length = 4, height = 1;

  polyfem::Points domain() const {
    polyfem::Points corners(2, 4);
    corners << 0, length, length, 0,  //
        -height / 2, -height / 2, height / 2, height / 2;
    return corners;
  }
  polyfem::Mat3 elasticity() const {
    return polyfem::elasticity_matrix(young, poisson, polyfem::Plane::strain);
  }
  polyfem::Vec3 stress(const polyfem::Vec2& x) const {
    return {force * (length - x.x()) * x.y() / inertia(), 0,
            -force / (2 * inertia()) * (height * height / 4 - x.y() * x.y())};
  }
  polyfem::Vec2 displacement(const polyfem::Vec2& point) const {
    const double E = young / (1 - poisson * poisson), nu = poisson / (1 - poisson);  // those of plane stress
    const double x = point.x(), y = point.y(), L = length, H2 = height * height;
    const double factor = force / (6 * E * inertia());
    return {factor * y * ((6 * L - 3 * x) * x + (2 + nu) * (y * y - H2 / 4)),
            -factor * (3 * nu * y * y * (L - x) + (4 + 5 * nu) * H2 * x / 4 + (3 * L - x) * x * x)};
  }

 private:
  double inertia() const { return height * height * height / 12; }
};

}  // namespace support
