/// \file What assertions ask of matrices.
#pragma once

#include <ddacontact/core/types.hpp>

namespace ddacontact {

/// Whether a square matrix is symmetric to round-off; false where an entry is NaN.
inline bool is_symmetric(const MatrixXd& A) {
  constexpr double round_off = 1e-6;  // of the largest entry; slipping bonds of bolts lose half the digits
  return (A - A.transpose()).cwiseAbs().maxCoeff() <= round_off * A.cwiseAbs().maxCoeff();
}

}  // namespace ddacontact
