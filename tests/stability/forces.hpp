/// \file What contacts do in every substep of a run: momentum, cone, dissipation.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>

namespace stability {

/// Over the steps of a run, with every substep a step of its own where the scene asks for none smaller.
struct ContactCheck {
  long contacts = 0;          ///< closed ones looked at
  double outside = 0;         ///< shear beyond the bound, or tension beyond its, over the largest contact force
  double work = 0;            ///< gained by the slip of a contact, over its shear times the block's size
  double friction_gain = 0;   ///< fall of the energy dissipated by friction in a step, over the largest kinetic
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
