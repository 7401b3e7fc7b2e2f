#include <ddacontact/scene/outline_distance.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/static_check.hpp>

#include <ddacontact/detection/broad_phase.hpp>

#include <algorithm>

namespace ddacontact::scene_format {

namespace {

constexpr std::size_t most_loose = 1000;

/// Blocks of a domain or a grid, which stand at one place of the file.
bool are_of_one_place(const SourceLocation& a, const SourceLocation& b) {
  return a.source == b.source && a.line == b.line && a.column == b.column;
}

/// The blocks that each one nearly touches.
std::vector<std::vector<int>> find_neighbours(const std::vector<PositionedOutline>& blocks) {
  std::vector<Box> boxes;
  for (const PositionedOutline& block : blocks)
    boxes.push_back(bounding_box(block.outline.polygon, nearly_touching * block.outline.size));
  std::vector<std::vector<int>> neighbours(blocks.size());
  for (const auto& [a, b] : overlapping_pairs(boxes)) {
    const double gap = distance_between(blocks[a].outline.polygon, blocks[b].outline.polygon);
    if (gap > nearly_touching * size_of_pair(blocks[a], blocks[b])) continue;
    neighbours[a].push_back(b);
    neighbours[b].push_back(a);
  }
  return neighbours;
}

/// The boxes of the blocks in a frame whose y points against gravity.
std::vector<Box> boxes_along(const Vec2& gravity, const std::vector<PositionedOutline>& blocks) {
  const Vec2 up = -gravity.normalized();
  Eigen::Matrix2d frame;
  frame << up.y(), -up.x(), up.x(), up.y();
  std::vector<Box> boxes;
  for (const PositionedOutline& block : blocks) boxes.push_back(bounding_box(frame * block.outline.polygon));
  return boxes;
}

bool falls_onto(const Box& block, const Box& other) {
  return block.low.x() < other.high.x() && other.low.x() < block.high.x() && other.low.y() < block.low.y();
}

/// Spreads from blocks that are held to those they hold.
class SupportedBlocks {
 public:
  /// Of all blocks, those it `has` are there.
  SupportedBlocks(const std::vector<std::vector<int>>& neighbours, const std::vector<bool>& has)
      : neighbours_(neighbours), is_settled_(has) {
    is_settled_.flip();
    for (std::size_t b = 0; b < has.size(); ++b)
      if (has[b]) loose_.push_back(static_cast<int>(b));
  }

  void hold(int block) {
    if (is_settled_[block]) return;
    is_settled_[block] = true;
    supported_.push_back(block);
  }
  void spread_to_neighbours() {
    for (; n_spread_ < supported_.size(); ++n_spread_)
      for (const int neighbour : neighbours_[supported_[n_spread_]]) hold(neighbour);
    std::erase_if(loose_, [this](int block) { return is_settled_[block]; });
  }
  void spread_upwards(const std::vector<Box>& boxes) {
    for (std::size_t i = 0; i < supported_.size() && !loose_.empty(); ++i) {
      const Box& below = boxes[supported_[i]];
      for (const int block : loose_)
        if (falls_onto(boxes[block], below)) hold(block);
      if (n_spread_ < supported_.size()) spread_to_neighbours();
    }
  }
  const std::vector<int>& loose() const { return loose_; }

 private:
  const std::vector<std::vector<int>>& neighbours_;
  std::vector<bool> is_settled_;        ///< held, or not there
  std::vector<int> supported_, loose_;  ///< in the order in which they were found; in that of the scene
  std::size_t n_spread_ = 0;            ///< of supported_, those whose neighbours are held
};

/// The blocks of a part that nothing holds.
std::vector<int> find_loose(const StaticPart& part, const BlockTable& blocks,
                            const std::vector<std::vector<int>>& neighbours) {
  SupportedBlocks supported(neighbours, part.has);
  for (int b = 0; b < blocks.names.size(); ++b)
    if (blocks.holds.holds_any(b)) supported.hold(b);
  supported.spread_to_neighbours();
  for (const Vec2& gravity : part.gravities) supported.spread_upwards(boxes_along(gravity, blocks.outlines));
  return supported.loose();
}

}  // namespace

std::vector<StaticPart> static_parts(const Scene& scene) {
  StaticPart part{"a static analysis", std::vector<bool>(scene.blocks.size(), true), {}};
  for (const StageDescription& stage : scene.stages)
    for (const int block : stage.added) part.has[block] = false;
  const auto pull = [&part](const Vec2& gravity) {
    const bool known =
        std::find(part.gravities.begin(), part.gravities.end(), gravity) != part.gravities.end();
    if (!gravity.isZero(0) && !known) part.gravities.push_back(gravity);
  };
  std::vector<StaticPart> parts;
  if (scene.stages.empty() && scene.analysis.mode == Mode::statics) {
    pull(scene.analysis.gravity);
    parts.push_back(part);
  }
  for (std::size_t i = 0; i < scene.stages.size(); ++i) {
    const StageDescription& stage = scene.stages[i];
    for (const int block : stage.removed) part.has[block] = false;
    for (const int block : stage.added) part.has[block] = true;
    if (stage.analysis.mode == Mode::dynamic) {
      part.after_motion = true;
      continue;
    }
    pull(stage.analysis.gravity);
    part.title = "stage " + (stage.name.empty() ? std::to_string(i) : "'" + excerpt(stage.name) + "'") +
                 ", which is static";
    parts.push_back(part);
  }
  return parts;
}

void check_statics(const BlockTable& blocks, const std::vector<StaticPart>& parts,
                   const std::vector<std::vector<int>>& tied, ProblemList& problems) {
  if (parts.empty()) return;
  std::vector<std::vector<int>> neighbours = find_neighbours(blocks.outlines);
  for (const std::vector<int>& by_bolt : tied)
    for (const int a : by_bolt) neighbours[a].insert(neighbours[a].end(), by_bolt.begin(), by_bolt.end());
  std::vector<bool> is_listed(blocks.outlines.size(), false);
  std::size_t n_listed = 0;
  for (const StaticPart& part : parts) {
    const auto complain = part.after_motion ? &ProblemList::warning : &ProblemList::error;
    std::vector<int> loose = find_loose(part, blocks, neighbours);
    std::erase_if(loose, [&](int block) { return is_listed[block]; });
    for (const int block : loose) {
      if (is_listed[block]) continue;
      const auto n_here = std::ranges::count_if(loose, [&](int other) {
        const bool here = are_of_one_place(blocks.outlines[block].location, blocks.outlines[other].location);
        if (here) is_listed[other] = true;
        return here;
      });
      if (n_listed++ == most_loose) {
        (problems.*complain)(blocks.outlines[block].location, "more blocks without support follow",
                             "only the first " + std::to_string(most_loose) + " are listed");
        return;
      }
      (problems.*complain)(blocks.outlines[block].location,
                           blocks.names.title(block) +
                               (n_here > 1 ? " and " + std::to_string(n_here - 1) + " more are" : " is") +
                               " free and nothing can hold " + (n_here > 1 ? "them" : "it") + " in " +
                               part.title + (part.after_motion ? ", unless it has moved before" : ""),
                           "hold a vertex, or let it rest on something held, or use mode = \"dynamic\"");
    }
  }
}

}  // namespace ddacontact::scene_format
