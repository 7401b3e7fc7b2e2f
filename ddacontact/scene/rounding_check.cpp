#include <ddacontact/scene/rounding_check.hpp>

#include <ddacontact/block/rounded_corners.hpp>
#include <ddacontact/scene/text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact::scene_format {

void check_corner_rounding(const Document& document, const Scene& scene, const BlockTable& blocks,
                           ProblemList& problems) {
  const double ratio = scene.contact.corner_rounding;
  if (ratio == 0) return;
  double largest = std::numeric_limits<double>::infinity(), of_any = 0;
  std::string edge;
  for (std::size_t b = 0; b < blocks.outlines.size(); ++b) {
    const CheckedOutline& outline = blocks.outlines[b].outline;
    const LargestRounding of_block = largest_rounding(outline.polygon);
    of_any = std::max(of_any, of_block.radius / outline.size);
    if (of_block.radius >= largest * outline.size) continue;
    largest = of_block.radius / outline.size;
    const Index n = outline.polygon.cols(), k = of_block.edge;
    const double length = (outline.polygon.col((k + 1) % n) - outline.polygon.col(k)).norm();
    edge = "an edge of " + blocks.names.title(static_cast<int>(b)) + ", " + rounded(length) + " m long";
  }
  if (ratio < largest) return;
  const double digit = std::pow(10, std::floor(std::log10(largest)) - 1);  // the second one
  const SourceLocation location = document.contact.locations.of("corner_rounding");
  const std::string what = "'corner_rounding' = '" + short_number(ratio) + "' leaves nothing of " + edge,
                    cure = "write at most " + rounded(std::floor(0.999 * largest / digit) * digit) + ", or 0";
  if (ratio < of_any)
    problems.warning(location, what + ": arcs of blocks with such edges are smaller", cure);
  else
    problems.error(location, what, cure);
}

}  // namespace ddacontact::scene_format
