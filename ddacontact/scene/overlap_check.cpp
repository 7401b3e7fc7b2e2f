#include <ddacontact/scene/overlap_check.hpp>
#include <ddacontact/scene/text.hpp>

#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/separation.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

namespace {

constexpr int most_overlaps = 1000;
/// Overlaps up to this part of the size may come from rounded coordinates.
constexpr double rounding = 0.05;

}  // namespace

double size_of_pair(const PositionedOutline& a, const PositionedOutline& b) {
  if (a.held) return b.outline.size;
  if (b.held) return a.outline.size;
  return std::min(a.outline.size, b.outline.size);
}

bool check_overlaps(const std::vector<PositionedOutline>& blocks, const NameTable& names,
                    ProblemList& problems) {
  std::vector<int> index;
  std::vector<Box> boxes;
  for (int i = 0; i < static_cast<int>(blocks.size()); ++i) {
    if (!blocks[i].outline.valid()) continue;
    index.push_back(i);
    boxes.push_back(bounding_box(blocks[i].outline.polygon));
  }
  // In growing parts of the scene, so that a heap of blocks on top of each other is given up early: it has
  // more pairs than fit into memory.
  int found = 0;
  std::size_t done = 0;
  while (done < boxes.size()) {
    const std::size_t next = std::min(boxes.size(), std::max<std::size_t>(1024, 2 * done));
    const std::vector<Box> part(boxes.begin(), boxes.begin() + static_cast<std::ptrdiff_t>(next));
    for (const auto& [a, b] : overlapping_pairs(part)) {
      if (static_cast<std::size_t>(b) < done) continue;
      const PositionedOutline &p = blocks[index[a]], &q = blocks[index[b]];
      if ((p.held && q.held) || !p.meets(q)) continue;
      const double depth = -separation(p.outline.polygon, q.outline.polygon);
      const double limit = deepest_overlap * size_of_pair(p, q);
      if (depth <= limit) continue;
      if (++found > most_overlaps) {
        problems.error(q.location, "more overlapping blocks follow",
                       "only the first " + std::to_string(most_overlaps) + " pairs are listed");
        return false;
      }
      problems.error(
          q.location,
          names.title(index[b]) + " overlaps " + names.title(index[a]) + " by " + rounded(depth) + " m",
          "move them apart; up to " + rounded(limit) + " m, 1e-3 of the size, is accepted" +
              (depth <= rounding * size_of_pair(p, q)
                   ? "; 'snap' at the top of the file mends rounded coordinates"
                   : ""));
    }
    done = next;
  }
  return found == 0;
}

}  // namespace ddacontact::scene_format
