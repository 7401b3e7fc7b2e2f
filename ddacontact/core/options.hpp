/// \file What an analysis may choose, with the defaults.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/material/linear_elastic.hpp>

namespace ddacontact {

using polyfem::GradientCorrection;
using polyfem::Plane;

/// Which defaults; written "default", "paper".
enum class Preset { standard, paper };
/// Velocities carry over | every step starts at rest.
enum class Mode { dynamic, statics };
/// The unknowns of a block: displacements of its vertices | the six of (1).
enum class BlockModel { wachspress, affine };
/// How displacements add up: increments on the current shape, Eq. (12).
enum class Kinematics { incremental };
/// The time scheme: Newmark (1/2, 1), Eq. (24)-(27).
enum class Scheme { dda };
/// How contact states are found: open-close iteration.
enum class ContactMethod { classic };

/// Steps, laws of motion and defaults of the blocks.
struct AnalysisOptions {
  Preset preset = Preset::standard;
  Mode mode = Mode::dynamic;
  int steps = 0;
  double time_step = 0;  ///< s
  double max_displacement_ratio = 0.1;
  Vec2 gravity{0.0, -9.8};  ///< m/s2
  Plane plane = Plane::strain;
  BlockModel block_model = BlockModel::wachspress;  ///< "auto" is resolved
  Kinematics kinematics = Kinematics::incremental;
  Scheme scheme = Scheme::dda;
  GradientCorrection gradient_correction = GradientCorrection::on;  ///< off in the paper preset
  double cutting_factor = 0.3;  ///< a rejected step is tried again with this times its length
};

/// Springs of the contacts.
struct ContactOptions {
  ContactMethod method = ContactMethod::classic;
  double normal_stiffness = 0;       ///< N/m per m; > 0 once resolved
  double tangential_stiffness = 0;   ///< N/m per m; > 0 once resolved
  double penetration_tolerance = 0;  ///< of the block size; 0 = plain penalty
};

}  // namespace ddacontact
