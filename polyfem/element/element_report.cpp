#include <polyfem/element/element_report.hpp>
#include <polyfem/element/matrices.hpp>
#include <polyfem/material/linear_elastic.hpp>

#include <cmath>
#include <limits>
#include <sstream>

namespace polyfem {
namespace {

/// A rule that leaves a deformation less than half of its energy, or more than twice, says nothing of it.
constexpr double largest_factor = 2;

void examine_shape(const PointsRef& polygon, ElementReport& report) {
  const Index n = polygon.cols();
  report.least_turn = report.least_angle = report.shortest_edge = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < n; ++i) {
    const Vec2 before = polygon.col(i) - polygon.col((i + n - 1) % n);
    const Vec2 edge = polygon.col((i + 1) % n) - polygon.col(i);
    const double turn = cross(before, edge) / (before.norm() * edge.norm());
    // A corner that turns by more than a right angle is sharp, not straight.
    if (const double bend = before.dot(edge) > 0 ? std::abs(turn) : 1; bend < report.least_turn) {
      report.least_turn = bend;
      report.straightest_corner = static_cast<int>(i);
    }
    const double angle = std::atan2(cross(before, edge), -before.dot(edge));  // < 0 at a reflex corner
    if (angle >= 0 && angle < report.least_angle) {
      report.least_angle = angle;
      report.sharpest_corner = static_cast<int>(i);
    }
    if (edge.norm() < report.shortest_edge) {
      report.shortest_edge = edge.norm();
      report.shortest_edge_index = static_cast<int>(i);
    }
  }
}

}  // namespace

ElementReport examine(const PointsRef& polygon, const Basis& basis, const TabulatedElement& element,
                      std::string rule) {
  ElementReport report;
  report.rule = std::move(rule);
  report.n_points = static_cast<int>(element.n_points());
  report.error = estimate_errors(polygon, basis, element);
  const Mat3 D = elasticity_matrix(1, 0.3, Plane::strain);
  TabulatedElement fine;
  MatrixXd K, M, exact_K;
  stiffness(element, D, K);
  mass(element, M);
  tabulate_to_tolerance(polygon, basis, 1e-8, GradientCorrection::on, fine);
  stiffness(fine, D, exact_K);
  report.energy = compare_energies(K, exact_K);
  const Definiteness definiteness = judge(K, M);
  report.zero_modes = definiteness.zero_modes;
  report.condition = 1 / definiteness.least_stiffness;
  report.least_mass = definiteness.least_mass;
  report.definite = definiteness.definite() && report.energy.least >= 1 / largest_factor &&
                    report.energy.largest <= largest_factor;
  examine_shape(polygon, report);
  report.shortest_edge /= std::sqrt(element.area);
  return report;
}

std::string describe(const ElementReport& report) {
  std::ostringstream text;
  text.precision(2);
  text << report.rule << ", " << report.n_points << " points, errors about " << report.error.stiffness
       << " of K and " << report.error.mass << " of M; "
       << (report.definite ? "full rank and positive definite" : "rank-deficient or indefinite") << ": "
       << report.zero_modes << " zero modes, energies " << report.energy.least << " to "
       << report.energy.largest << " of the exact ones, condition " << report.condition << ", least mass "
       << report.least_mass << "; corner " << report.straightest_corner << " turns by " << report.least_turn
       << ", corner " << report.sharpest_corner << " has an angle of " << report.least_angle << ", edge "
       << report.shortest_edge_index << " is " << report.shortest_edge << " long";
  return text.str();
}

}  // namespace polyfem
