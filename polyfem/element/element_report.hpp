/// \file An element's own account: accuracy, rank and definiteness, shape.
#pragma once

#include <polyfem/element/definiteness.hpp>
#include <polyfem/element/tolerance.hpp>

#include <string>

namespace polyfem {

/// What there is to know of an element before using it.
struct ElementReport {
  std::string rule;  ///< in words, as given
  int n_points = 0;
  ErrorEstimate error;   ///< of K and M, see `estimate_errors`
  int zero_modes = 0;    ///< of K; a full-rank element has 3
  double condition = 0;  ///< of K: the largest eigenvalue over the smallest that is not zero; < 0: indefinite
  double least_mass = 0;  ///< the smallest eigenvalue of M over its largest; must be > 0
  EnergyRange energy;     ///< of deformations by K, over their energies by a rule to 1e-8
  /// K and M are as `judge` wants them, and every deformation has between half and twice its energy: a rule
  /// of too few points keeps full rank long after it has lost sight of a function that is large in a small
  /// place.
  bool definite = false;
  double least_turn = 0;  ///< sine of the turning angle where the polygon is nearest to straight
  int straightest_corner = 0;
  double least_angle = 0;  ///< the smallest angle inside, in radians
  int sharpest_corner = 0;
  double shortest_edge = 0;  ///< over the square root of the area
  int shortest_edge_index = 0;
};

/// Examines an element tabulated on a polygon. K is that of plane strain with nu = 0.3. For set-up: O(n^3),
/// and tabulates the element again, by `tabulate_to_tolerance`, whose errors it throws.
ElementReport examine(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element,
                      std::string rule);

/// One line for people.
std::string describe(const ElementReport& report);

}  // namespace polyfem
