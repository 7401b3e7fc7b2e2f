/// \file A part of a run, as the stepper takes it.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/core/options.hpp>

#include <vector>

namespace ddacontact {

/// What holds while a part of a run lasts. Of the analysis plane, kinematics and preset are those of the
/// whole run.
struct Stage {
  AnalysisOptions analysis;          ///< `steps` are those of this part
  JointTable joints;                 ///< of its contacts
  std::vector<int> removed;          ///< blocks taken out at its start
  bool reset_displacements = false;  ///< at its end: displacements are counted anew
};

}  // namespace ddacontact
