#include <ddacontact/time/driven_blocks.hpp>

#include <ddacontact/core/deepest_overlap.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/detection/broad_phase.hpp>
#include <ddacontact/detection/separation.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

/// How deep b is in a, or minus their distance, m.
double depth(const BlockSystem& blocks, const BlockState& state, int a, int b) {
  return -separation(blocks.outline_from(state, a, a), blocks.outline_from(state, b, a));
}

}  // namespace

std::optional<Pair> find_driven_overlap(const BlockSystem& blocks, const BlockState& end,
                                        const std::function<bool(const Pair&)>& gives_way) {
  std::vector<int> fully_prescribed;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (blocks.is_present(b) && !blocks.is_movable(b)) fully_prescribed.push_back(b);
  for (int a : fully_prescribed) {
    if (blocks.is_unchanging(a)) continue;
    const Box box = bounding_box(blocks.outline_from(end, a, a));
    for (int b : fully_prescribed) {
      const bool seen = b <= a && !blocks.is_unchanging(b);
      if (seen || !touch(box, bounding_box(blocks.outline_from(end, b, a)))) continue;
      const double limit = coincidence * std::min(blocks.block(a).size(), blocks.block(b).size()),
                   now = depth(blocks, end, a, b);
      if (now > limit && now > std::max(0.0, depth(blocks, blocks.drawn(), a, b)) + limit &&
          !gives_way({std::min(a, b), std::max(a, b)}))
        return Pair{a, b};
    }
  }
  return {};
}

std::optional<Pair> find_overlap(const BlockSystem& blocks, const BlockState& state,
                                 const std::vector<int>& coming, const std::vector<int>& leaving) {
  if (coming.empty()) return {};
  std::vector<int> there = coming;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (blocks.is_present(b) && std::ranges::count(leaving, b) == 0) there.push_back(b);
  std::vector<Box> boxes;
  for (int b : there) boxes.push_back(bounding_box(blocks.outline_from(state, b, coming.front())));
  const auto n_coming = static_cast<int>(coming.size());
  for (const auto& [p, q] : overlapping_pairs(boxes)) {
    if (p >= n_coming || q < n_coming) continue;
    const int a = there[p], b = there[q];
    if (depth(blocks, state, a, b) >
        deepest_overlap * std::min(blocks.block(a).size(), blocks.block(b).size()))
      return Pair{a, b};
  }
  return {};
}

}  // namespace ddacontact
