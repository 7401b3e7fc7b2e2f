/// \file Friction bounds that agree with the normal forces they lead to.
#pragma once

#include <ddacontact/core/types.hpp>

#include <functional>

namespace ddacontact {

/// Finds bounds b = f(b), each to 1e-9 of the largest. No theorem says that it does: the fixed-point
/// iteration is accelerated (Anderson) while that gains, and damped for a while when contacts keep changing
/// their states.
/// \param[in] solve       solves the problem with the bounds frozen and gives those that its forces would
///                        have
/// \param[in,out] bounds  where to start; then those of the last problem solved
/// \return whether every bound agrees
bool iterate_bounds(const std::function<void(const VectorXd& bounds, VectorXd& wanted)>& solve,
                    VectorXd& bounds);

}  // namespace ddacontact
