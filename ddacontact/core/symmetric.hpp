/// \file What assertions ask of matrices.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Whether a square matrix is symmetric to round-off; false where an entry is NaN.
inline bool is_symmetric(const MatrixXd& A) {
  constexpr double round_off = 1e-9;  // of the largest entry
  return (A - A.transpose()).cwiseAbs().maxCoeff() <= round_off * A.cwiseAbs().maxCoeff();
}

}  // namespace ddacontact
