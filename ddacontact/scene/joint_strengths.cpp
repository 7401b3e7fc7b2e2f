#include <ddacontact/scene/joint_strengths.hpp>

#include <cmath>
#include <numbers>
#include <optional>

namespace ddacontact {

namespace {

std::optional<double> tangent_of(const std::optional<double>& degrees) {
  if (!degrees) return std::nullopt;
  return std::tan(*degrees * std::numbers::pi / 180);
}

}  // namespace

JointTable joint_table(const std::vector<Joint>& joints) {
  std::vector<JointTable::Entry> entries;
  for (const Joint& joint : joints)
    entries.push_back({{std::tan(joint.friction_angle * std::numbers::pi / 180),
                        joint.cohesion,
                        joint.tensile_strength,
                        {},
                        joint.restitution,
                        joint.dashpot,
                        joint.glued,
                        joint.normal_stiffness.value_or(0),
                        joint.shear_stiffness.value_or(0),
                        tangent_of(joint.residual_friction_angle),
                        tangent_of(joint.dilation_angle).value_or(0),
                        joint.dilation_slip.value_or(0),
                        joint.ductile,
                        joint.compressive_strength.value_or(0)},
                       joint.between});
  return JointTable(std::move(entries));
}

int joint_of_edge(const Scene& scene, const JointTable& joints, int block, int edge, int other) {
  const std::vector<int>& of_edges = scene.blocks[block].edge_joints;
  if (!of_edges.empty() && of_edges[edge] >= 0) return of_edges[edge];
  return joints.number_between(scene.blocks[block].material, scene.blocks[other].material);
}

}  // namespace ddacontact
