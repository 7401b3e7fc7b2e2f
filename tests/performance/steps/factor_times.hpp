/// \file What a factor of a matrix takes, by CHOLMOD and by the fronts of polydda.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

namespace step_performance {

/// How the rows are ordered: both on the graph of vertices, of two rows each.
enum class Ordering { amd, metis };

/// Processor time in s, medians of three except the analysis; MB of the factor.
struct FactorTimes {
  double analysis = 0, factorization = 0, solution = 0;
  double factor = 0;
};

/// Supernodal where CHOLMOD takes that for faster; BLAS as it is set. All 0 when the factor would be larger
/// than `most_mb`. Throws polyfem::Error when CHOLMOD fails.
FactorTimes cholmod_times(const polyfem::SparseMatrix& lower, Ordering ordering, double most_mb);

/// L L^T as steps make it, ordered as polyfem::Cholesky does; the analysis finds the fronts too.
FactorTimes own_times(const polyfem::SparseMatrix& lower);

}  // namespace step_performance
