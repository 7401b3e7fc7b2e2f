/// \file One contact, its two forces found from its law while those of all others stay.
#pragma once

#include <ddacontact/solver/contact_term.hpp>
#include <ddacontact/solver/swept_law.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

/// A contact whose blocks answer to its own forces: its gap grows by `normal` N + `mixed` T and its slip by
/// `mixed` N + `shear` T.
struct SweptContact {
  double normal = 0, mixed = 0, shear = 0;                  ///< m per N per m; positive definite
  double normal_compliance = 0, tangential_compliance = 0;  ///< of the law's springs, m per N per m
  double gap = 0, slip = 0;  ///< m, where sweeps begin, from where its springs are at rest
  double tension = 0;        ///< infinite where it never opens
  CoulombBound bound = {};
  const JointLaw* own_law = nullptr;  ///< of one that is bonded, or has a JointLaw::friction_law
  bool acts = false, slides = false, sheared = false, bonded = false;
  bool lets_go = false;  ///< no force acts where it is open

  /// Takes the law, with gap and slip at d.
  void set_law(const ContactTerm& term, const SweptLaw& own, const VectorXd& d);
  /// The largest magnitude of T under N; infinity where shear has no bound.
  double bound_under(double N) const {
    return own_law && slides ? shear_bound(*own_law, N, bonded) : bound.under(N);
  }
  /// Whether its springs and blocks answer to forces as they must: stiffnesses beyond all others cancel.
  bool is_positive_definite() const {
    const double an = normal_compliance + normal, at = tangential_compliance + shear;
    return an > 0 && (!sheared || an * at - mixed * mixed > 0);
  }
  /// The forces that the law demands of one that is positive definite.
  /// \param[in] gap_before, slip_before  m, with the contact's own forces `before`
  [[gnu::always_inline]] ContactForce solve(double gap_before, double slip_before,
                                            const ContactForce& before = {}) const {
    const double an = normal_compliance + normal,
                 rn = normal * before.normal + mixed * before.shear - gap_before;
    if (!sheared) return {std::max(-tension, rn / an), 0};
    const double at = tangential_compliance + shear,
                 rt = mixed * before.normal + shear * before.shear - slip_before;
    const double determinant = an * at - mixed * mixed;
    assert(determinant > 0);
    const ContactForce stick{(rn * at - rt * mixed) / determinant, (rt * an - rn * mixed) / determinant};
    if (stick.normal > -tension && std::abs(stick.shear) <= bound_under(stick.normal)) return stick;
    // Where friction that sticks would pull the contact open it slides under what presses without it; a bond
    // that is pulled open bears shear.
    const double near = stick.normal > -tension ? stick.normal : rn / an;
    if (near <= -tension || !slides) {
      const double most = bound_under(-tension);
      return {-tension, std::clamp((rt + mixed * tension) / at, -most, most)};
    }
    // N with T = +- bound(N), the bound linear from there.
    const double sense = stick.shear > 0 ? 1 : -1, most = bound_under(near),
                 rate = sense * (own_law ? friction_rate(*own_law, near, bonded) : bound.friction);
    const double N = std::max(-tension, (rn - mixed * (sense * most - rate * near)) / (an + rate * mixed));
    return {N, sense * bound_under(N)};
  }
};

}  // namespace ddacontact
