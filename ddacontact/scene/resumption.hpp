/// \file Whether a checkpoint belongs to a scene.
#pragma once

#include <ddacontact/output/checkpoint.hpp>
#include <ddacontact/scene/problem.hpp>
#include <ddacontact/scene/scene.hpp>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ddacontact {

/// What must be the same of a scene that a run is resumed with, as the text of a scene file: everything but
/// steps and [output].
std::string resumable_part(const Scene& scene);

/// The steps of the stages up to one, it included.
std::vector<int> steps_of_stages_to(const Scene& scene, int stage);

/// Why a run cannot be resumed with this scene, at the place in the scene's file; nothing when it can: the
/// parts that must be the same are, the stages that are over have the steps that they had, and the present
/// one has at least those that are made, and no more when displacements were reset at its end.
///
/// \param[in] checkpoint_name, scene_file  as the messages call them
std::optional<Problem> find_mismatch(const Checkpoint& checkpoint, const std::string& checkpoint_name,
                                     const Scene& scene, const std::string& scene_file);

/// A scene that goes on from a run as its next stage, or its next stages: what the checkpoint has made, then
/// this scene. Loads, water, shaking, strengths of joints and all that a [[stage]] may change may differ.
/// \return why it cannot, at the place in the scene's file: other blocks, supports or materials, say
std::variant<Scene, Problem> scene_as_stage(const Checkpoint& checkpoint, const std::string& checkpoint_name,
                                            const Scene& scene, const std::string& scene_file);

}  // namespace ddacontact
