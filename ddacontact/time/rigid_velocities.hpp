/// \file Jumps of velocity of blocks as rigid bodies that collide.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/joint_law.hpp>

#include <functional>
#include <vector>

namespace ddacontact {

/// A contact that may take part in an impact; of its forms only the coefficients matter.
struct ImpactContact {
  AffineForm gap, slip;                                  ///< over the same unknowns in the same order
  double gap_rate = 0, slip_rate = 0;                    ///< beside those of the velocities given, m/s
  double friction = 0;                                   ///< |P_T| <= friction P_N
  std::function<double(double)> friction_law = nullptr;  ///< instead: the bound of |P_T| under P_N >= 0
  double restitution = 0;  ///< 0 .. 1, of the normal impulse; 0 where blocks merely touch
  bool bonded = false;     ///< no relative motion at all; takes no restitution

  double bound(double normal) const {
    return friction_law ? friction_law(normal) : CoulombBound{friction}.under(normal);
  }
};

/// Impulse of a contact on the gap and on the slip, N s per m of thickness.
struct ContactImpulse {
  double normal = 0, shear = 0;
};

/// A jump of velocities.
struct JumpReport {
  bool settled = true;  ///< rates that should vanish do, and friction agrees with the normal impulses
  /// The impulses of restitution, or all, had to be taken in part so that no kinetic energy arises.
  bool limited = false;
  VectorXd jump;                         ///< of the velocities of all unknowns
  std::vector<ContactImpulse> impulses;  ///< of every contact
  double friction_loss = 0;  ///< - sum of P_T and the mean of the slip rates before and after, J per m
  /// Loss by normal impulses, likewise, J per m. Rates are those of rigid motions here; the sum of both
  /// losses is lost by the kinetic energy and the work of moving supports.
  double normal_loss = 0;
  /// Work of the supports' impulses, J per m: the kinetic energy changes by it less the losses.
  double support_work = 0;
};

/// The jump of the velocities v when contacts collide: impulses P_N >= 0 that leave no approach, P_N u_N = 0,
/// with friction |P_T| <= mu P_N opposed to the slip (compression); then, as Poisson, e P_N is given back at
/// each contact, and contact and friction act once more, so that nothing approaches in the end. u are rates
/// of the forms, of all unknowns; the jump is a rigid motion of each block that its prescribed degrees of
/// freedom allow. Momentum is that of the impulses, equal and opposite. The
/// kinetic energy never rises.
/// \param[in] state           where the blocks are
/// \param[in] least_approach  m/s: only islands with a contact that approaches faster take part
JumpReport impact(const BlockSystem& blocks, const BlockState& state,
                  const std::vector<ImpactContact>& contacts, const VectorXd& v, double least_approach);

}  // namespace ddacontact
