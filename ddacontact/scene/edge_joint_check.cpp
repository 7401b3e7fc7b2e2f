#include <ddacontact/scene/edge_joint_check.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/touching_edges.hpp>
#include <ddacontact/scene/joint_strengths.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <string>

namespace ddacontact::scene_format {

void warn_of_two_joints_on_a_face(const Scene& scene, const BlockTable& blocks, ProblemList& problems) {
  const auto names_joints = [](const BlockDescription& block) { return !block.edge_joints.empty(); };
  if (std::ranges::none_of(scene.blocks, names_joints)) return;
  std::vector<Box> boxes;
  for (const BlockDescription& block : scene.blocks) boxes.push_back(bounding_box(block.vertices));
  const JointTable joints = joint_table(scene.joints);
  const auto title_of = [&](int joint) {
    const std::string& name = scene.joints[joint].name;
    return "joint " + (name.empty() ? std::to_string(joint) : scene_format::quoted(name));
  };
  int found = 0;
  std::string first;
  SourceLocation location;
  for (const auto& [a, b] : overlapping_pairs(boxes)) {
    const PositionedOutline &p = blocks.outlines[a], &q = blocks.outlines[b];
    if (!(names_joints(scene.blocks[a]) || names_joints(scene.blocks[b])) || (p.held && q.held) ||
        !p.meets(q))
      continue;
    for (const TouchingEdges& touch : touching_edges(scene.blocks[a].vertices, scene.blocks[b].vertices,
                                                     edges_touch * size_of_pair(p, q))) {
      const int edge_a = static_cast<int>(touch.edge), edge_b = static_cast<int>(touch.other),
                of_a = joint_of_edge(scene, joints, a, edge_a, b),
                of_b = joint_of_edge(scene, joints, b, edge_b, a);
      if (of_a == of_b) continue;
      if (++found > 1) continue;
      first = "edge " + std::to_string(edge_a) + " of " + blocks.names.title(a) + " follows " +
              title_of(of_a) + ", edge " + std::to_string(edge_b) + " of " + blocks.names.title(b) +
              ", which it touches, " + title_of(of_b);
      location = q.location;
    }
  }
  if (found == 0) return;
  if (found > 1) first += ", and " + std::to_string(found - 1) + " more such pairs of edges";
  problems.warning(location, first + ": each contact follows the edge that its vertex meets",
                   "name one joint on both in 'edge_joints'");
}

}  // namespace ddacontact::scene_format
