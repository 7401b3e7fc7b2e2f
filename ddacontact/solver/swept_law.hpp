/// \file What sweeps and the interior-point method know of a contact beside its term.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

namespace ddacontact {

/// The law of one contact, and where the step found it.
struct SweptLaw {
  const JointLaw* joint = nullptr;
  double shear = 0;      ///< the shear multiplier as the step began
  bool sliding = false;  ///< it is at the bound, whatever that is
  bool bonded = false;
  double scale = 1;  ///< what changes of the contact's force are relative to, N per m
  double gap = 0;    ///< and what the way is that they move it by, m; 0: any way
};

}  // namespace ddacontact
