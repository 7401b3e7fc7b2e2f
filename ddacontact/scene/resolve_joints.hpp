/// \file Joints of a scene file, and what its stages change of them.
#pragma once

#include <ddacontact/scene/names.hpp>

#include <vector>

namespace ddacontact::scene_format {

struct NamedJoints {
  NameTable names{"joint"};
  std::vector<Joint> joints;
};

/// `method` is that of the scene, resolved. A scene without joints has one called "default".
NamedJoints resolve_joints(const Document& document, const NameTable& materials, ContactMethod method,
                           ProblemList& problems);

/// The joints of the scene as they are while a stage lasts.
std::vector<Joint> changed_joints(const StageRecord& stage, const NamedJoints& of_scene,
                                  const ContactRecord& contact, ContactMethod method, ProblemList& problems);

}  // namespace ddacontact::scene_format
