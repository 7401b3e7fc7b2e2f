/// \file What the program and the Python module write of a run in the same way.
#pragma once

#include <ddacontact/output/frame_options.hpp>
#include <ddacontact/scene/scene.hpp>
#include <ddacontact/time/stepper.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace dda {

/// What frames hold of a scene.
ddacontact::FrameOptions frame_options(const ddacontact::Scene& scene, int n_threads);

/// The scene as run, in place of an older one once it is whole. Throws OutputError.
void write_scene_file(const std::filesystem::path& path, const ddacontact::Scene& scene);

/// The scheme of the present stage, as scenes write it.
std::string scheme_word(const ddacontact::Stepper& stepper);

/// Whether the run has made the steps requested in all, or those of its stages, of which `until` may have
/// ended some.
bool is_done(const ddacontact::Stepper& stepper, const std::optional<int>& steps = {});

}  // namespace dda
