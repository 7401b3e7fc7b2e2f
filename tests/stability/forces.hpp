/// \file What contacts do in every substep of a run: momentum, cone, dissipation.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>

namespace stability {

/// The worst after any step of a run.
struct ContactCheck {
  long contacts = 0;   ///< closed ones looked at
  double outside = 0;  ///< shear beyond its bound, or tension beyond its, over the largest contact force
  double work = 0;     ///< slip of a sliding contact with its friction instead of against it, over its size
  double work_over_energy =
      0;  ///< the work that friction does so, over the largest energy in the scene so far
  double dissipation_falls = 0;  ///< what friction or impacts have dissipated becomes less, over the same
  std::string stopped_by;
};
ContactCheck check_contacts(const ddacontact::Scene& scene, int steps);

/// The change of the linear momentum of all free blocks over the steps of a scene without external forces, at
/// most, over the sum of |m v| at the start.
double momentum_drift(const ddacontact::Scene& scene, int steps);

/// Four bonded squares that fly and turn: contacts bear in every step, nothing acts from outside.
ddacontact::Scene flying_assembly(ddacontact::Scheme scheme);
/// A block that bounces to and fro within a free box of heavy bonded walls.
ddacontact::Scene bouncing_in_a_box(ddacontact::Scheme scheme);

}  // namespace stability
