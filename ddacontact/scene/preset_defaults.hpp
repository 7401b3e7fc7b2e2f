/// \file What the presets choose for keys that a scene leaves out.
#pragma once

#include <ddacontact/scene/value_text.hpp>

#include <string>

namespace ddacontact::scene_format {

/// Defaults that differ from preset to preset.
struct PresetDefaults {
  Kinematics kinematics;
  Scheme scheme;
  GradientCorrection gradient_correction;
  double cutting_factor;
  ContactMethod method;
  BlockModel block_model;
};

inline constexpr PresetDefaults standard_defaults{Kinematics::corotational, Scheme::decaying,
                                                  GradientCorrection::on,   0.5,
                                                  ContactMethod::staged,    BlockModel::automatic};
inline constexpr PresetDefaults paper_defaults{Kinematics::incremental, Scheme::dda,
                                               GradientCorrection::off, 0.3,
                                               ContactMethod::classic,  BlockModel::wachspress};

constexpr const PresetDefaults& defaults_of(Preset preset) {
  return preset == Preset::paper ? paper_defaults : standard_defaults;
}

/// A default in words, for the documentation: `true`; preset "paper": `false`.
template <class T>
std::string preset_text(T PresetDefaults::*member) {
  return '`' + value_text(standard_defaults.*member) + "`; preset \"paper\": `" +
         value_text(paper_defaults.*member) + '`';
}

}  // namespace ddacontact::scene_format
