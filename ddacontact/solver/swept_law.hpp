/// \file Data of a contact beside its term, for sweeps and the interior-point method.
#pragma once

#include <ddacontact/contact/joint_law.hpp>

namespace ddacontact {

/// The law of one contact, with its state at the start of the step.
struct SweptLaw {
  const JointLaw* joint = nullptr;
  double shear = 0;  ///< shear multiplier at the start of the step, N per m
  bool bonded = false;
  double scale = 1;  ///< reference force of the convergence test, N per m
  double gap = 0;    ///< largest gap change counted as converged, m; 0: no test
};

}  // namespace ddacontact
