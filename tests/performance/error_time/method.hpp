/// \file The ways to analyse a scene that are compared.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <optional>
#include <string>
#include <vector>

namespace error_time {

/// The default, but for what is stated.
struct Method {
  std::string name, description;
  ddacontact::BlockModel model = ddacontact::BlockModel::automatic;
  ddacontact::Scheme scheme = ddacontact::Scheme::decaying;
  double penetration_tolerance = 1e-6;           ///< of the block size
  std::optional<double> contact_tolerance = {};  ///< see ContactOptions::tolerance
  bool paper = false;                            ///< the preset of that name
};

/// The first is the default.
const std::vector<Method>& all_methods();
const Method& method_of(const std::string& name);

/// Sets the analysis, contacts and models of the blocks that are not fixed; of a scene without stages.
void apply(const Method& method, ddacontact::Scene& scene);

/// A static stage, in which friction is 45 degrees, before the scene's own steps.
void settle_first(ddacontact::Scene& scene, int steps, double time_step);

}  // namespace error_time
