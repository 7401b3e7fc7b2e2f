/// \file A contact as the equations see it: springs on its gap and its slip with multipliers and bounds.
#pragma once

#include <ddacontact/core/affine_form.hpp>

#include <cstddef>

namespace ddacontact {

/// A contact with its friction bound frozen: N = lambda - p g on the gap, kept >= -tension where unilateral,
/// and T = tau - p_t s on the slip, kept within +-bound. Both are gradients of convex potentials of the
/// unknowns.
struct ContactTerm {
  AffineForm gap, slip;  ///< over the same unknowns in the same order where `sheared`
  double normal_stiffness = 0, tangential_stiffness = 0;  ///< p, p_t, N/m per m
  double normal_multiplier = 0;                           ///< lambda, N per m
  double tangential_multiplier = 0;                       ///< tau; the bound is of T alone
  double bound = 0;                                       ///< of |T|; infinity: cannot slide
  double tension = 0;                                     ///< a bond's strength

  /// absent: no force at all, neither normal nor shear (the vertex is not on the edge).
  enum class Normal { unilateral, bilateral, absent } normal = Normal::unilateral;
  bool sheared = true;  ///< false: nothing acts along the slip
};

/// A term rate * grad s (grad g)^T of the matrix: friction of a contact that follows its normal force.
struct Coupling {
  std::size_t contact;
  double rate;  ///< N/m per m
  bool operator==(const Coupling&) const = default;
};

/// A force that follows its form, F = force - stiffness * change of the form, clipped to [low, high].
struct ClippedSpring {
  double force = 0;  ///< where the form is evaluated, not clipped
  double stiffness = 0;
  double low = 0, high = 0;

  double clipped() const { return force < low ? low : force > high ? high : force; }
  /// Whether the force follows the form; at a bound that can move both ways it does.
  bool acts() const { return low < high && force >= low && force <= high; }
};

/// The spring on the gap at d.
inline ClippedSpring normal_spring(const ContactTerm& c, const VectorXd& d) {
  if (c.normal == ContactTerm::Normal::absent) return {};
  return {c.normal_multiplier - c.normal_stiffness * c.gap(d), c.normal_stiffness,
          c.normal == ContactTerm::Normal::unilateral ? -c.tension : -inf, inf};
}
/// The spring on the slip at d.
inline ClippedSpring tangential_spring(const ContactTerm& c, const VectorXd& d) {
  if (c.normal == ContactTerm::Normal::absent || !c.sheared) return {};
  return {c.tangential_multiplier - c.tangential_stiffness * c.slip(d), c.tangential_stiffness, -c.bound,
          c.bound};
}

/// Both springs of a contact.
struct ContactSprings {
  ClippedSpring normal, tangential;
};
/// Both springs of a contact at d.
inline ContactSprings springs_at(const ContactTerm& c, const VectorXd& d) {
  return {normal_spring(c, d), tangential_spring(c, d)};
}

/// Forces on the gap and on the slip, N per m: the residual has -(normal grad g + shear grad s).
struct ContactForce {
  double normal = 0, shear = 0;
};
/// The forces of the contact at d, each within its bounds.
inline ContactForce contact_force(const ContactTerm& c, const VectorXd& d) {
  return {normal_spring(c, d).clipped(), tangential_spring(c, d).clipped()};
}

/// Bits of the state of a contact: which springs act, and where friction has reached its bound.
enum SpringState : unsigned char {
  none_acts = 0,
  normal_acts = 1,
  shear_acts = 2 * normal_acts,
  at_upper = 2 * shear_acts,
  at_lower = 2 * at_upper,
  all_act = normal_acts | shear_acts
};

/// The springs that the tangent has at d, sticking ones the tangential one too.
inline unsigned char active_springs(const ContactTerm& c, const VectorXd& d) {
  return (normal_spring(c, d).acts() ? normal_acts : none_acts) |
         (tangential_spring(c, d).acts() ? shear_acts : none_acts);
}

}  // namespace ddacontact
