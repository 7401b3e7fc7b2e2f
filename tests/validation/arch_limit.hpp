/// \file Limit analysis of a semicircular arch of rigid voussoirs that carries its own weight.
///
/// The arch is symmetric, and so is a thrust line if there is any: two numbers are free, the horizontal
/// thrust H and the moment M of the springing's force about the middle of its joint. At every joint the
/// normal force N, the shear force T and the moment are linear in them, and it holds when
///     |M| <= N t/2  (the force passes inside the joint),    |T| <= mu N.
/// These are half planes; the arch can stand when they have a point in common.
#pragma once

#include <ddacontact/core/types.hpp>

#include <vector>

namespace validation {

/// Equal voussoirs between radial joints, mean radius 1, weight 1 per unit of area.
struct ArchShape {
  int n_voussoirs = 0;
  double thickness = 0;
  bool curved = false;  ///< edges along the arch are arcs; else the voussoirs are trapezoids
};

/// What a joint can do when there is but one thrust line left, by joints from the right springing.
struct ArchJoint {
  double normal = 0;
  double eccentricity = 0;  ///< of the normal force over half the thickness: 1 at the outer edge
  double obliquity = 0;     ///< T / N; > 0 pushes what is further along the arch outwards
};

/// The joints for one of the thrust lines that hold; none: there is no such line.
std::vector<ArchJoint> joints_that_hold(const ArchShape& arch, double friction);

/// The least thickness over mean radius, to 1e-9.
double least_thickness(int n_voussoirs, double friction, bool curved = false);

}  // namespace validation
