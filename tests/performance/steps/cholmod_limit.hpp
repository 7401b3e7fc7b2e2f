/// \file What CHOLMOD alone takes for a matrix: the limit of a step that factorizes once.
#pragma once

#include <polyfem/assembly/cholesky.hpp>

namespace step_performance {

/// How the rows are ordered: both on the graph of vertices, of two rows each.
enum class Ordering { amd, metis };

/// Processor time in s, medians of three except the analysis; MB of the factor.
struct CholmodTimes {
  double analysis = 0, factorization = 0, solution = 0;
  double factor = 0;
};

/// Supernodal where CHOLMOD takes that for faster; BLAS as it is set. All 0 when the factor would be larger
/// than `most_mb`. Throws polyfem::Error when CHOLMOD fails.
CholmodTimes cholmod_times(const polyfem::SparseMatrix& lower, Ordering ordering, double most_mb);

}  // namespace step_performance
