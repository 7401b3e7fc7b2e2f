/// \file From a scene to a system of blocks ready to step.
#pragma once

#include <ddacontact/output/labels.hpp>
#include <ddacontact/scene/scene.hpp>
#include <ddacontact/time/monitor_target.hpp>
#include <ddacontact/time/stepper.hpp>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ddacontact {

/// A scene ready to step, and what names its results.
struct BuiltScene {
  std::unique_ptr<Stepper> stepper;
  std::vector<MonitorTarget> monitor_targets;  ///< the scene's monitors
  Labels labels;
  std::vector<std::string> notes;  ///< what the user should know: rules raised, rank-deficient elements, ...
};

/// Builds what a checked scene describes. Throws Error for what only shows here: supports that an affine
/// block cannot follow.
/// \param[in] in_between  called before each part of the work that takes long; what it throws ends the work
BuiltScene build(
    const Scene& scene, const std::function<void()>& in_between = [] {});

/// The scene with the models that `build` puts in the place of "auto".
Scene with_chosen_models(const Scene& scene);

}  // namespace ddacontact
