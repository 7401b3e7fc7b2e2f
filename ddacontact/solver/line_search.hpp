/// \file The exact minimum of a piecewise quadratic along a line.
#pragma once

#include <ddacontact/solver/contact_term.hpp>

#include <span>

namespace ddacontact {

/// A clipped spring on the points d + t step.
struct LineSpring {
  ClippedSpring at_start;  ///< at t = 0
  double rate;             ///< derivative in t of the form that it follows

  ClippedSpring at(double t) const {
    ClippedSpring moved = at_start;
    moved.force -= moved.stiffness * rate * t;
    return moved;
  }
};

/// The t > 0 at which the potential of springs and of a quadratic is least on the points d + t step: where its
/// derivative in t vanishes, which is continuous, piecewise linear, never falls, and must be negative at 0. Where
/// the potential falls for ever, a t beyond all changes of its springs.
/// \param[in] slope, curvature  the derivative of the quadratic alone is slope + t curvature
double minimum_along(std::span<const LineSpring> springs, double slope, double curvature);

}  // namespace ddacontact
