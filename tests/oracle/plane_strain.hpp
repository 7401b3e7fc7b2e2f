/// \file A plane strain problem with a known solution, for deal.II and for us.
#pragma once

#include <polyfem/core/types.hpp>

namespace oracle {

/// Displacements of degree three and what belongs to them.
struct PlaneStrain {
  double lambda = 1.3, mu = 0.7;

  polyfem::Vec2 displacement(const polyfem::Vec2& p) const {
    const double x = p.x(), y = p.y();
    return {x * x * x + x * y * y, x * x * y - 2 * y * y * y};
  }
  polyfem::Mat2 stress(const polyfem::Vec2& p) const {
    const double x = p.x(), y = p.y();
    polyfem::Mat2 gradient;
    gradient << 3 * x * x + y * y, 2 * x * y,  //
        2 * x * y, x * x - 6 * y * y;
    return lambda * gradient.trace() * polyfem::Mat2::Identity() + mu * (gradient + gradient.transpose());
  }
  /// Minus the divergence of the stress.
  polyfem::Vec2 body_force(const polyfem::Vec2& p) const {
    return (lambda + 2 * mu) * polyfem::Vec2(-8 * p.x(), 10 * p.y());
  }
};

/// Under tractions on boundary 1, elsewhere held.
constexpr unsigned loaded_boundary = 1;

}  // namespace oracle
