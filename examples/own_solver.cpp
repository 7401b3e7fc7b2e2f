// A contact solver of one's own: it sees the matrix and the contacts of a step, and nothing of blocks.
//
//   wall                     Three blocks in a row, each of mass m and with the unknowns (x, y). The force P
//    |[ 1 ][ 2 ][ 3 ]<-- P   presses them against a wall. Friction alone carries their weights W = m g.
//    |  W    W    W          If 3 W <= mu P they stay, and T = 3 W, 2 W and W in the joints.
//                            If not, joint 0 slides: the three fall together, and T = mu P (1, 2/3, 1/3).
//
// The method is the nonsmooth Gauss-Seidel iteration of Moreau and Jean in the forces. Displacements always
// balance the forces f of the contacts, d = d0 + A^-1 (sum of f grad g - g0). Each force in turn takes the
// value that its law demands; the others are kept. The friction bound is mu N of the same sweep. The
// minimizer of the library takes the bounds as given; with those found here it finds the same forces.
#include <ddacontact/solver/friction_problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

using namespace ddacontact;

/// One force along one affine form: normal along the gap or shear along the slip.
struct Row {
  const AffineForm& form;
  VectorXd displacement;  ///< of all unknowns, by a unit force, A^-1 grad
  double compliance;      ///< change of the form by a unit force, grad . A^-1 grad
  double force = 0;

  Row(FrictionProblem& problem, const AffineForm& of, Index n) : form(of) {
    VectorXd gradient = VectorXd::Zero(n);
    form.add_gradient(1, gradient);
    problem.solve(gradient, displacement);
    compliance = form.change(displacement);
  }
  /// Gives the force the value of its spring within its bounds. Returns its change.
  double visit(const ClippedSpring& spring, VectorXd& d) {
    ClippedSpring next = spring;  // implicit: the spring follows the change of its own force
    next.force = force + (spring.force - force) / (1 + spring.stiffness * compliance);
    const double change = next.clipped() - force;
    force += change;
    d += change * displacement;
    return std::abs(change);
  }
};

/// Moves d to the solution and writes its friction bounds into the terms. Returns the forces: taken from d,
/// they would have the remaining error of gap and slip times the stiffness.
std::vector<ContactForce> gauss_seidel(FrictionProblem& problem, std::vector<ContactTerm>& terms, double mu,
                                       const VectorXd& g0, double tolerance, VectorXd& d) {
  if (!problem.factorize(terms, std::vector<unsigned char>(terms.size(), 0)))
    throw Error("A is not positive definite");
  VectorXd free_motion;
  problem.solve(-g0, free_motion);
  d += free_motion;
  std::vector<std::array<Row, 2>> rows;  // normal and shear of each contact
  for (const ContactTerm& term : terms)
    rows.push_back({Row(problem, term.gap, d.size()), Row(problem, term.slip, d.size())});
  double largest_change = tolerance + 1;
  for (int sweep = 0; sweep < 1000 && largest_change > tolerance; ++sweep) {
    largest_change = 0;
    for (std::size_t c = 0; c < terms.size(); ++c) {
      auto& [normal, shear] = rows[c];
      const double change_of_normal = normal.visit(normal_spring(terms[c], d), d);
      terms[c].bound = mu * normal.force;
      const double change_of_shear = shear.visit(tangential_spring(terms[c], d), d);
      largest_change = std::max({largest_change, change_of_normal, change_of_shear});
    }
  }
  if (largest_change > tolerance) throw Error("1000 sweeps were not enough");
  std::vector<ContactForce> forces;
  for (const auto& [normal, shear] : rows) forces.push_back({normal.force, shear.force});
  return forces;
}

/// The largest error of the contact forces relative to mu P, with this solver and with the library's.
double error_with_friction(double mu) {
  constexpr double m = 1000, g = 10, P = 60e3, dt = 0.01, stiffness = 1e14;
  FrictionProblem problem({0, 1, 2, 3, 4, 5}, 6);  // unknowns of block b: 2 b and 2 b + 1, all of them free
  polyfem::Connectivity blocks;
  std::vector<ContactTerm> terms(3);  // wall to 1, 1 to 2, 2 to 3
  VectorXd g0(6);                     // less the weights and P; A d is the inertia of a step from rest
  for (int b = 0; b < 3; ++b) {
    const int x = 2 * b, y = x + 1;
    blocks.append(std::array{x, y});
    g0.segment<2>(x) << (b == 2 ? P : 0), m * g;
    ContactTerm& term = terms[static_cast<std::size_t>(b)];
    term.normal_stiffness = term.tangential_stiffness = stiffness;
    const auto add_side = [&](int of_x, double sign) {  // gap and slip must list the same unknowns
      term.gap.add(of_x, sign);
      term.gap.add(of_x + 1, 0);
      term.slip.add(of_x, 0);
      term.slip.add(of_x + 1, sign);
    };
    add_side(x, 1);
    if (b > 0) add_side(x - 2, -1);
  }
  problem.set_matrices(blocks);
  for (MatrixXd& A : problem.elements()) A = m / (dt * dt) * MatrixXd::Identity(2, 2);
  problem.matrices_changed();

  VectorXd own = VectorXd::Zero(6), of_library = own;
  const std::vector<ContactForce> forces = gauss_seidel(problem, terms, mu, g0, 1e-8 * P, own);
  if (problem.minimize(terms, g0, {.tolerance = 1e-10 * P}, of_library).status != MinimizeStatus::converged)
    throw Error("the minimizer of the library has not converged");

  double error = 0;
  for (std::size_t c = 0; c < terms.size(); ++c) {
    const double by_hand = std::min(m * g, mu * P / 3) * static_cast<double>(3 - c);
    const ContactForce &force = forces[c], other = contact_force(terms[c], of_library);
    std::cout << "mu = " << mu << ", joint " << c << ": T = " << force.shear << ", by the library "
              << other.shear << ", by hand " << by_hand << " N/m\n";
    for (const double difference : {force.normal - P, force.shear - by_hand, other.shear - by_hand})
      error = std::max(error, std::abs(difference) / (mu * P));
  }
  return error;
}

int main() {
  const double error = std::max(error_with_friction(0.6), error_with_friction(0.4));  // at rest, sliding
  std::cout << "largest relative error " << error << '\n';
  return error < 1e-5 ? 0 : 1;
}
