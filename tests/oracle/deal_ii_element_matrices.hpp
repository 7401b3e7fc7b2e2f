/// \file Element matrices computed by deal.II, an independent judge. Its headers stay in the source file.
#pragma once

#include <polyfem/core/types.hpp>

namespace oracle {

/// In the order d = (u1 v1 u2 v2 ...), the vertices as given.
struct ElementMatrices {
  polyfem::MatrixXd stiffness;  ///< of an isotropic body in plane strain
  polyfem::MatrixXd mass;       ///< for density one
};

/// Linear triangle (three vertices) or bilinear isoparametric quadrilateral (four), counter-clockwise, with
/// `n_gauss` points in each direction for the quadrilateral; the triangle's rule is exact.
ElementMatrices deal_ii_element_matrices(const polyfem::Points& vertices, double young, double poisson,
                                         unsigned n_gauss);

}  // namespace oracle
