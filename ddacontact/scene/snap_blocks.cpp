#include <ddacontact/scene/snap_blocks.hpp>

#include <ddacontact/scene/text.hpp>

#include <polyfem/mesh/outline_snapping.hpp>

namespace ddacontact::scene_format {

void snap_blocks(Document& document, ProblemList& problems) {
  if (!document.snap) return;
  std::vector<Points> outlines;
  for (const BlockRecord& block : document.blocks) {
    if (!block.locations.good("vertices") || block.vertices.points.cols() < 3)
      return;  // that is told elsewhere
    outlines.push_back(block.vertices.points);
  }
  if (outlines.empty()) return;
  const polyfem::Snapping snapping = polyfem::snap_outlines(outlines, *document.snap);
  if (snapping.collapsed) {
    const BlockRecord& block = document.blocks[*snapping.collapsed];
    return problems.error(
        block.locations.of("vertices"),
        "two vertices of the block are nearer than 'snap' = '" + short_number(*document.snap) + "' m",
        "snap by less, or take its short edges out: dda cut --shortest-edge L");
  }
  for (std::size_t b = 0; b < outlines.size(); ++b) document.blocks[b].vertices.points = outlines[b];
  if (snapping.n_moved > 0) document.snapped = {snapping.n_moved, snapping.farthest};
}

}  // namespace ddacontact::scene_format
