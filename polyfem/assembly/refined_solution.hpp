/// \file Solutions in double precision with a factor in single precision.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

namespace polyfem {

/// x = K^-1 b by refinement: a rough solution of what is left, again and again, until what is left of each
/// row is round-off of its terms (Skeel's criterion; J. Langou et al., "Exploiting the performance of 32 bit
/// floating point arithmetic in obtaining 64 bit accuracy", 2006). False when a step gains less than a
/// digit: K is too ill-conditioned then, x is not to be used.
///
/// \param[in] lower   the matrix of the last factor
/// \param     rough   its factor, as `factorize_roughly` makes it
[[nodiscard]] bool refined_solution(const SparseMatrix& lower, Cholesky& rough, const VectorXd& b,
                                    VectorXd& x);

}  // namespace polyfem
