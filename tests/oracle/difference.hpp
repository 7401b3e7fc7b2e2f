/// \file How far an element of deal.II is from ours.
#pragma once

#include <tests/oracle/deal_ii_elements.hpp>

namespace oracle {

constexpr double young = 1, poisson = 0.3;

/// Largest over shape functions and points, relative over matrices.
struct Difference {
  double values = 0;     ///< |N_i - N_i'|
  double gradients = 0;  ///< |grad N_i - grad N_i'| over the largest gradient at that point
  double stiffness = 0;  ///< in the Frobenius norm
  double mass = 0;

  /// The larger of both, entry by entry.
  static Difference larger(const Difference& a, const Difference& b);
};

/// Of Wachspress functions without correction, with deal.II's own points and weights, so that N, grad N and
/// the integrands of K and M meet point by point and no error of integration comes in.
Difference difference_to_ours(const polyfem::Points& polygon, const Element& theirs);

/// The same for elements made by `deal_ii_elements` with n_gauss x n_gauss points, one for each polygon.
std::vector<Difference> differences(const std::vector<polyfem::Points>& polygons, unsigned n_gauss);

}  // namespace oracle
