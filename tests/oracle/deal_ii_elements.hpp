/// \file Elements computed by deal.II, an independent judge. Its headers stay in the source file.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

#include <vector>

namespace oracle {

/// What deal.II has for a polygon of three or four vertices, in the order of these.
struct Element {
  polyfem::TabulatedElement table;  ///< N_i and grad N_i at deal.II's points, with its weights
  polyfem::MatrixXd stiffness;      ///< of an isotropic body in plane strain, d = (u1 v1 u2 v2 ...)
  polyfem::MatrixXd mass;           ///< for density one
};

/// Bilinear isoparametric quadrilaterals with n_gauss x n_gauss points, or, when all polygons have three
/// vertices, linear triangles with a rule that is exact. Counter-clockwise.
std::vector<Element> deal_ii_elements(const std::vector<polyfem::Points>& polygons, double young,
                                      double poisson, unsigned n_gauss);

/// The stiffness of deal.II's Q2 on counter-clockwise parallelograms, restricted to the functions without
/// x^2 y^2: the middle follows the boundary, u = (sum of middles) / 2 - (sum of corners) / 4. Nodes are a
/// corner and the middle of the edge after it in turn, 16 x 16.
std::vector<polyfem::MatrixXd> deal_ii_serendipity_stiffness(const std::vector<polyfem::Points>& polygons,
                                                             double young, double poisson);

}  // namespace oracle
