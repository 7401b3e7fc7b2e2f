/// \file Solutions with a Cholesky factor whose columns are stored in dense groups.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

struct cholmod_factor_struct;

namespace polyfem {

/// x = (L L^T)^-1 b, L supernodal and of real numbers with its ordering. CHOLMOD asks BLAS for each group;
/// those of small blocks have a few columns, for which the calls cost more than what they do.
///
/// \param[in,out] work  storage
void solve_supernodal(const cholmod_factor_struct& L, const VectorXd& b, VectorXd& work, VectorXd& x);
/// The same in single precision.
///
/// \param[in] entries  see single_precision_entries
void solve_supernodal(const cholmod_factor_struct& L, const std::vector<float>& entries, const VectorXd& b,
                      Eigen::VectorXf& work, VectorXd& x);

/// The entries of L, rounded.
std::vector<float> single_precision_entries(const cholmod_factor_struct& L);

}  // namespace polyfem
