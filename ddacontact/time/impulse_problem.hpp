/// \file Impulses between rigid motions with frozen friction bounds.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>
#include <ddacontact/time/rigid_motions.hpp>

#include <vector>

namespace ddacontact {

/// A number for the normal direction and one for the shear of every contact, in two columns: impulses, or
/// rates of gap and slip.
using NormalAndShear = Eigen::Matrix<double, Eigen::Dynamic, 2>;
/// Columns of NormalAndShear.
enum Column { of_gap, of_slip };

/// Rates of gaps and slips under velocities.
NormalAndShear rates_of(const std::vector<ContactTerm>& terms, const VectorXd& velocities);

/// The change w of the coefficients of rigid motions of least |w|^2 / 2 that contacts allow: their impulses
/// are multipliers of the rates, found in rounds of penalty problems. Each round starts from the change that
/// its multipliers make, so that the springs see small rates only and do not take up the round-off of large
/// ones.
class ImpulseProblem {
 public:
  /// \param[in] terms  forms of the coefficients, kinds and bounds; stiffnesses are chosen here
  ImpulseProblem(const RigidMotions& motions, std::vector<ContactTerm> terms);

  /// Replaces the bounds of shear but those that are infinite.
  void set_bounds(const VectorXd& bounds);
  NormalAndShear impulses() const;
  void forget_impulses();
  /// The change w by impulses, and the changes of the rates by w.
  VectorXd change(const NormalAndShear& impulses) const;
  NormalAndShear change_of_rates(const VectorXd& w) const { return rates_of(terms_, w); }

  /// Finds the impulses, starting from those set, when `rates` are those without any; false when rates that
  /// should vanish remain larger than the tolerance.
  bool solve(const NormalAndShear& rates, double tolerance);

  /// Largest rate after the last `solve` that should vanish: approach, separation under an impulse, slip
  /// while sticking.
  double largest_rate() const;

 private:
  void set_rates(const NormalAndShear& rates, const VectorXd& w);

  std::vector<ContactTerm> terms_;
  int n_;
  double steepest_ = 0;  ///< the largest coefficient of a rate: an error of w makes so large a one of it
  FrictionProblem problem_;
};

}  // namespace ddacontact
