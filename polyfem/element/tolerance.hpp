/// \file Elements whose matrices are good to a requested tolerance, and how good those of any rule are.
#pragma once

#include <polyfem/element/tabulated_element.hpp>

#include <string_view>

namespace polyfem {

/// Estimated errors of an element's matrices, relative to them in the Frobenius norm.
struct ErrorEstimate {
  double stiffness = 0;  ///< of K, plane strain with nu = 0.3; nearly the same for any compressible material
  double mass = 0;       ///< of M
};

/// Estimates by integrals that are known exactly, so without another rule: of grad N_i (half the chord
/// between the neighbours of vertex i, turned right, as N_i is linear on edges) and of 1, x and x x^T
/// (which, as x = sum x_i N_i, is M between linear fields). The factors were measured: with the rules of
/// `tabulate_to_tolerance` the estimates bound the true errors in all but rare cases and exceed them about
/// tenfold; with symmetric and collapsed rules true errors of K may be five
/// times, of M twenty times the estimate.
/// The element must be tabulated on this polygon, with or without correction.
ErrorEstimate estimate_errors(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element);

/// What `tabulate_to_tolerance` reached.
struct ToleranceReport {
  bool met = false;  ///< both estimates are within the tolerance
  ErrorEstimate error;
  int n_points = 0;
  std::string_view rule;  ///< in words
};

/// Tabulates a basis with as few points as give K and M to a relative tolerance, by estimate. Triangles take
/// 3 points. Functions smooth at the vertices of a strictly convex polygon, as a trial shows, take
/// `make_adjoint_rule`, others `make_vertex_rule`, with growing numbers of points until the estimate is met.
/// When it is not within 30 000 points (64 in a line) and 42 digits, beyond which round-off prevails, or is
/// no finite number, the report says so: the element has the rule of the least estimate, or that without one.
/// Throws Error unless 0 < tolerance < 1, and when the polygon (see `require_usable`) or the basis is unfit.
ToleranceReport tabulate_to_tolerance(const PointsRef& polygon, const Basis& basis, double tolerance,
                                      GradientCorrection correction, TabulatedElement& element);

/// The same of a quadratic cell (see `tabulate_quadratic`) and the basis of its corners. Triangles take 6
/// points. Errors are the differences of K and M to those of a rule with two thirds of the points or fewer:
/// the element's own are smaller, as they fall with the number of points. When they are not met within 30 000
/// points and twice the digits, the report says so: the element has the last rule then.
ToleranceReport tabulate_quadratic_to_tolerance(const PointsRef& cell, const Basis& basis, double tolerance,
                                                GradientCorrection correction, TabulatedElement& element);

}  // namespace polyfem
