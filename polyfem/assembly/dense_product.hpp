/// \file Products of dense blocks, for fronts.
#pragma once

#include <polyfem/assembly/front_tree.hpp>

namespace polyfem {

/// C -= A B^T, from the diagonal of C down where `is_lower`: what is above it counts for nothing then. The same
/// bytes by all processors, where `by_blas` does not leave larger blocks to BLAS.
template <class Real>
void subtract_product(const DenseBlock<Real>& A, const DenseBlock<Real>& B, const DenseBlock<Real>& C,
                      bool is_lower, bool by_blas);

}  // namespace polyfem
