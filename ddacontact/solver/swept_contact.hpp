/// \file One contact, its two forces found from its law while those of all others stay.
#pragma once

#include <ddacontact/solver/contact_term.hpp>
#include <ddacontact/solver/swept_law.hpp>

namespace ddacontact {

/// A contact whose blocks answer to its own forces: its gap grows by `normal` N + `mixed` T and its slip by
/// `mixed` N + `shear` T.
struct SweptContact {
  double normal = 0, mixed = 0, shear = 0;  ///< m per N per m; positive definite
  bool acts = false, unilateral = true, slides = false, sheared = false;
  double normal_compliance = 0, tangential_compliance = 0;  ///< of the law's springs, m per N per m
  double gap = 0, slip = 0;  ///< m, where sweeps begin, the gap from where nothing presses
  double tension = 0;
  SweptLaw law = {};
  ContactForce force = {};  ///< now

  /// Takes the law, with gap and slip at d.
  void set_law(const ContactTerm& term, const SweptLaw& own, const VectorXd& d);
  /// The largest magnitude of T under N; infinity where shear has no bound.
  double bound_under(double N) const;
  /// The forces that the law demands.
  /// \param[in] gap_without, slip_without  m, without the contact's own forces
  ContactForce solve(double gap_without, double slip_without) const;
};

}  // namespace ddacontact
