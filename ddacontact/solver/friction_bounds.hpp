/// \file Friction bounds that agree with the normal forces they lead to.
#pragma once

#include <ddacontact/core/types.hpp>

#include <functional>

namespace ddacontact {

/// When iterate_bounds ends.
struct BoundsOptions {
  double tolerance = 1e-9;  ///< of every bound, relative to the largest
  int max_solves = 100;
};

/// How iterate_bounds ended.
struct BoundsReport {
  bool settled = false;  ///< every bound agrees
  int solves = 0;
};

/// Finds bounds b = f(b). No theorem says that it does: the fixed-point iteration is accelerated (Anderson)
/// while that gains, and damped for a while when contacts keep changing their states. \param[in] solve solves
/// the problem with the bounds frozen and gives those that its forces would have \param[in,out] bounds  where
/// to start; then those of the last problem solved
BoundsReport iterate_bounds(const std::function<void(const VectorXd& bounds, VectorXd& wanted)>& solve,
                            const BoundsOptions& options, VectorXd& bounds);

}  // namespace ddacontact
