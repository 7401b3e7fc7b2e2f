/// \file What Cook's membrane is compared with: there is no closed form.
#pragma once

#include <tests/performance/work_precision/measurement.hpp>

namespace work_precision {

/// Limits for h -> 0, with how much the last extrapolation changed them, relative.
struct Reference {
  double watched = 0, watched_uncertainty = 0;
  double work = 0, work_uncertainty = 0;
};

/// By deal.II's Q2 on three meshes that become finer towards the clamped corners, extrapolated by Aitken's
/// formula.
const Reference& reference_for(const Problem& problem);

/// Fills the relative errors: of the watched displacement in place of L2, and of the energy norm from the
/// work of the loads, |u - u_h|^2 = W - W_h by the orthogonality of Galerkin's method.
void compare_with_reference(const Problem& problem, Accuracy& accuracy);

}  // namespace work_precision
