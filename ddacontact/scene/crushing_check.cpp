#include <ddacontact/scene/crushing_check.hpp>

#include <ddacontact/detection/corner.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

void warn_of_vertices_in_crushed_faces(const Document& document, const BlockTable& blocks,
                                       ProblemList& problems) {
  const auto crushed = std::ranges::find_if(
      document.joints, [](const JointRecord& joint) { return joint.joint.compressive_strength.has_value(); });
  if (crushed == document.joints.end()) return;
  for (std::size_t b = 0; b < blocks.outlines.size(); ++b) {
    const Points& polygon = blocks.outlines[b].outline.polygon;
    for (int v = 0; v < polygon.cols(); ++v) {
      if (corner_at(polygon, v) != Corner::straight) continue;
      problems.warning(crushed->locations.of("compressive_strength"),
                       blocks.names.title(static_cast<int>(b)) +
                           " has a vertex within a straight face, at (" + short_number(polygon(0, v)) + ", " +
                           short_number(polygon(1, v)) + "), that bears without limit",
                       "leave vertices within faces out where joints crush");
      return;
    }
  }
}

}  // namespace ddacontact::scene_format
