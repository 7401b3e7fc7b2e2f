/// \file What an analysis may choose, with the defaults.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/element/tabulated_element.hpp>
#include <polyfem/material/linear_elastic.hpp>

namespace ddacontact {

using polyfem::GradientCorrection;
using polyfem::Plane;

enum class Preset { standard, paper };  ///< written "default", "paper"
enum class Mode { dynamic, statics };   ///< velocities carry over | every step starts at rest
enum class BlockModel { wachspress, affine };
enum class Kinematics { incremental };
enum class Scheme { dda };
enum class ContactMethod { classic };

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

struct ContactOptions {
  ContactMethod method = ContactMethod::classic;
  double normal_stiffness = 0;       ///< N/m per m; > 0 once resolved
  double tangential_stiffness = 0;   ///< N/m per m; > 0 once resolved
  double penetration_tolerance = 0;  ///< of the block size; 0 = plain penalty
};

}  // namespace ddacontact
