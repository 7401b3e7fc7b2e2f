#include <ddacontact/scene/rounding_check.hpp>

#include <ddacontact/block/rounded_corners.hpp>
#include <ddacontact/scene/text.hpp>

#include <cmath>
#include <limits>

namespace ddacontact::scene_format {

void check_corner_rounding(const Document& document, const Scene& scene, const BlockTable& blocks,
                           ProblemList& problems) {
  const double ratio = scene.contact.corner_rounding;
  if (ratio == 0) return;
  double largest = std::numeric_limits<double>::infinity();
  std::string edge;
  for (std::size_t b = 0; b < blocks.outlines.size(); ++b) {
    const CheckedOutline& outline = blocks.outlines[b].outline;
    const LargestRounding of_block = largest_rounding(outline.polygon);
    if (of_block.radius >= largest * outline.size) continue;
    largest = of_block.radius / outline.size;
    const Index n = outline.polygon.cols(), k = of_block.edge;
    const double length = (outline.polygon.col((k + 1) % n) - outline.polygon.col(k)).norm();
    edge = "an edge of " + blocks.names.title(static_cast<int>(b)) + ", " + rounded(length) + " m long";
  }
  if (ratio < largest) return;
  const double digit = std::pow(10, std::floor(std::log10(largest)) - 1);  // the second one
  problems.error(document.contact.locations.of("corner_rounding"),
                 "'corner_rounding' = '" + short_number(ratio) + "' leaves nothing of " + edge,
                 "write at most " + rounded(std::floor(0.999 * largest / digit) * digit) + ", or 0");
}

}  // namespace ddacontact::scene_format
