/// \file A Cholesky factor made in single precision: half the memory and half the time.
#pragma once

#include <polyfem/assembly/cholesky.hpp>
#include <polyfem/assembly/fronts.hpp>
#include <polyfem/core/large_vector.hpp>

#include <optional>

struct cholmod_factor_struct;

namespace polyfem {

/// L L^T = S K S, S diagonal such that S K S has ones on its diagonal.
struct SinglePrecisionFactor {
  VectorXd scale;              ///< the diagonal of S
  LargeVector<float> entries;  ///< of L, see Fronts

  double memory() const {
    return static_cast<double>(sizeof(float) * entries.capacity()) +
           static_cast<double>(sizeof(double)) * static_cast<double>(scale.size());
  }
};

/// Makes it by fronts.
///
/// Nothing when a pivot loses half of the digits, below sqrt(eps) of what stood there: K may be
/// ill-conditioned then, or not positive definite at all, which is for a factor in double precision to say.
///
/// \param[in] groups  supernodal, analyzed for the pattern of `lower`; its entries are not looked at
/// \param[in] tree    of these
std::optional<SinglePrecisionFactor> single_precision_factor(const cholmod_factor_struct& groups,
                                                             const FrontTree& tree,
                                                             const SparseMatrix& lower);

}  // namespace polyfem
