/// \file The strengths of a scene's joints, as contacts know them.
#pragma once

#include <ddacontact/contact/joint_table.hpp>
#include <ddacontact/scene/scene.hpp>

#include <vector>

namespace ddacontact {

/// In the order of the joints.
JointTable joint_table(const std::vector<Joint>& joints);

/// The joint that a vertex of another block follows on an edge: that of the edge, else that between the
/// materials.
/// \param[in] joints  the table of the scene's
int joint_of_edge(const Scene& scene, const JointTable& joints, int block, int edge, int other);

}  // namespace ddacontact
