/// \file The strengths of a scene's joints, as contacts know them.
#pragma once

#include <ddacontact/contact/joint_table.hpp>
#include <ddacontact/scene/scene.hpp>

#include <vector>

namespace ddacontact {

/// In the order of the joints.
JointTable joint_table(const std::vector<Joint>& joints);

}  // namespace ddacontact
