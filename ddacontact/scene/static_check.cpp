#include <ddacontact/scene/outline_distance.hpp>
#include <ddacontact/scene/static_check.hpp>

#include <ddacontact/detection/broad_phase.hpp>

#include <numeric>

namespace ddacontact::scene_format {

namespace {

constexpr std::size_t most_loose = 1000;

/// The blocks that each one nearly touches.
std::vector<std::vector<int>> find_neighbours(const std::vector<PlacedOutline>& blocks) {
  std::vector<Box> boxes;
  for (const PlacedOutline& block : blocks)
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
std::vector<Box> boxes_along(const Vec2& gravity, const std::vector<PlacedOutline>& blocks) {
  const Vec2 up = -gravity.normalized();
  Eigen::Matrix2d frame;
  frame << up.y(), -up.x(), up.x(), up.y();
  std::vector<Box> boxes;
  for (const PlacedOutline& block : blocks) boxes.push_back(bounding_box(frame * block.outline.polygon));
  return boxes;
}

bool falls_onto(const Box& block, const Box& other) {
  return block.low.x() < other.high.x() && other.low.x() < block.high.x() && other.low.y() < block.low.y();
}

/// Spreads from blocks that are held to those they hold.
class HeldBlocks {
 public:
  explicit HeldBlocks(const std::vector<PlacedOutline>& blocks)
      : neighbours_(find_neighbours(blocks)), is_held_(blocks.size(), false), loose_(blocks.size()) {
    std::iota(loose_.begin(), loose_.end(), 0);
  }

  void hold(int block) {
    if (is_held_[block]) return;
    is_held_[block] = true;
    held_.push_back(block);
  }
  void spread_to_neighbours() {
    for (; n_spread_ < held_.size(); ++n_spread_)
      for (const int neighbour : neighbours_[held_[n_spread_]]) hold(neighbour);
    std::erase_if(loose_, [this](int block) { return is_held_[block]; });
  }
  void spread_upwards(const std::vector<Box>& boxes) {
    for (std::size_t i = 0; i < held_.size() && !loose_.empty(); ++i) {
      const Box& below = boxes[held_[i]];
      for (const int block : loose_)
        if (falls_onto(boxes[block], below)) hold(block);
      if (n_spread_ < held_.size()) spread_to_neighbours();
    }
  }
  const std::vector<int>& loose() const { return loose_; }

 private:
  std::vector<std::vector<int>> neighbours_;
  std::vector<bool> is_held_;
  std::vector<int> held_, loose_;  ///< in the order in which they were found; in that of the scene
  std::size_t n_spread_ = 0;       ///< of held_, those whose neighbours are held
};

}  // namespace

void check_statics(const BlockTable& blocks, const Vec2& gravity, ProblemList& problems) {
  HeldBlocks held(blocks.outlines);
  for (int b = 0; b < blocks.names.size(); ++b)
    if (blocks.holds.holds_any(b)) held.hold(b);
  held.spread_to_neighbours();
  if (!gravity.isZero(0)) held.spread_upwards(boxes_along(gravity, blocks.outlines));

  for (std::size_t i = 0; i < held.loose().size(); ++i) {
    const int block = held.loose()[i];
    if (i == most_loose) {
      problems.error(blocks.outlines[block].place, "more blocks follow that nothing holds",
                     "only the first " + std::to_string(most_loose) + " are listed");
      return;
    }
    problems.error(blocks.outlines[block].place,
                   blocks.names.title(block) + " is free and nothing can hold it in a static analysis",
                   "hold a vertex, or let it rest on something held, or use mode = \"dynamic\"");
  }
}

}  // namespace ddacontact::scene_format
