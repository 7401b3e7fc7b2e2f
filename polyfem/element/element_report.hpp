/// \file An element's own account: accuracy, soundness, shape.
#pragma once

#include <polyfem/element/tolerance.hpp>

#include <string>

namespace polyfem {

/// What there is to know of an element before using it.
struct ElementReport {
  std::string rule;  ///< in words, as given
  int n_points = 0;
  ErrorEstimate error;   ///< of K and M, see `estimate_errors`
  int zero_modes = 0;    ///< of K; a sound element has 3
  double condition = 0;  ///< of K: the largest eigenvalue over the smallest that is not zero; < 0: indefinite
  double least_mass = 0;  ///< the smallest eigenvalue of M over its largest; must be > 0
  bool sound = false;     ///< see `judge`
  double least_turn = 0;  ///< sine of the turning angle where the polygon is nearest to straight
  int straightest_corner = 0;
  double least_angle = 0;  ///< the smallest angle inside, in radians
  int sharpest_corner = 0;
  double shortest_edge = 0;  ///< over the square root of the area
  int shortest_edge_index = 0;
};

/// Examines an element tabulated on a polygon. K is that of plane strain with nu = 0.3. O(n^3), for set-up.
ElementReport examine(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element,
                      std::string rule);

/// One line for people.
std::string describe(const ElementReport& report);

}  // namespace polyfem
