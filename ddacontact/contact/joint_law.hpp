/// \file Mohr-Coulomb: what a contact bears. Pure functions on values.
#pragma once

#include <algorithm>
#include <cassert>
#include <functional>

namespace ddacontact {

/// A friction law of one's own: the largest shear force that friction bears under a normal force N >= 0, both
/// in N per m of thickness and for one contact. 0 at N = 0, continuous, not decreasing.
struct FrictionLaw : std::function<double(double normal_force)> {
  using function::function;
  /// No one can tell whether two functions are the same.
  bool operator==(const FrictionLaw& other) const { return !*this && !other; }
};

/// Sliding is told apart by the sense of the slip, s of (50): forward along the edge from j to k.
enum class ContactState : unsigned char { open, stick, slip_forward, slip_backward };

/// Whether the contact is closed and slides, in either sense.
inline bool is_slipping(ContactState s) {
  return s == ContactState::slip_forward || s == ContactState::slip_backward;
}
/// +1, -1 for the two slip states, 0 otherwise.
inline double slip_sign(ContactState s) {
  return s == ContactState::slip_forward ? 1 : s == ContactState::slip_backward ? -1 : 0;
}

/// One contact's stiffnesses and bounds, forces per metre of thickness. Stresses times contact length.
struct JointLaw {
  double normal_stiffness = 0;                ///< p of (38)
  double tangential_stiffness = 0;            ///< p bar of (46)
  double friction = 0;                        ///< tan(phi)
  const FrictionLaw* friction_law = nullptr;  ///< in place of N tan(phi); not owned
  double cohesion = 0;                        ///< c l, while the contact is bonded
  double tension = 0;                         ///< tensile strength times l, while the contact is bonded
  bool compliant = false;  ///< stiffnesses are the joint's own times the length: forces follow gap and slip
  bool glued = false;      ///< closed by a joint that is glued: bonded, with infinite cohesion and tension
  bool ductile = false;    ///< a bond outlasts slip, and is lost by opening alone

  /// Nothing acts along the edge: no tangential terms are needed.
  bool frictionless() const { return !has_friction() && cohesion == 0; }
  bool has_friction() const { return friction > 0 || friction_law; }
};

/// Coulomb's bound of the shear force.
struct CoulombBound {
  double friction = 0;  ///< tan(phi)
  double cohesion = 0;  ///< of a bond; infinity where nothing slides

  double under(double normal_force) const { return std::max(0.0, normal_force) * friction + cohesion; }
};

/// The bound of the shear force: max(0, N) tan(phi), or what the friction law says, plus the cohesion while
/// bonded.
inline double shear_bound(const JointLaw& law, double normal_force, bool bonded) {
  assert(law.friction >= 0 && law.cohesion >= 0);
  const CoulombBound coulomb{law.friction, bonded ? law.cohesion : 0.0};
  if (law.friction_law) [[unlikely]]
    return (*law.friction_law)(std::max(0.0, normal_force)) + coulomb.cohesion;
  return coulomb.under(normal_force);
}
/// The bound for a solver on its way: where a contact without a bond is pulled it goes on as an odd function,
/// so that it has a derivative.
inline double extended_bound(const JointLaw& law, double normal_force, bool bonded) {
  return normal_force < 0 && !bonded ? -shear_bound(law, -normal_force, false)
                                     : shear_bound(law, normal_force, bonded);
}
/// The derivative of the extended bound by the normal force; where a bond is pulled the bound does not
/// change.
double friction_rate(const JointLaw& law, double normal_force, bool bonded);

}  // namespace ddacontact
