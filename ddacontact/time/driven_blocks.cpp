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
  if (std::ranges::none_of(blocks.prescribed_dofs(), &PrescribedDof::moves)) return {};
  std::vector<bool> is_driven(static_cast<std::size_t>(blocks.n_blocks()), false);
  for (const PrescribedDof& held : blocks.prescribed_dofs())
    if (held.moves()) is_driven[blocks.block_of_point(held.vertex)] = true;
  std::vector<int> held;
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (blocks.is_present(b) && !blocks.is_free(b)) held.push_back(b);
  std::vector<Box> boxes;
  for (int b : held) boxes.push_back(bounding_box(blocks.outline_from(end, b, held.front())));
  for (const auto& [p, q] : overlapping_pairs(boxes)) {
    const int a = held[p], b = held[q];
    if (!is_driven[a] && !is_driven[b]) continue;
    // What is held in part has contacts where it can give way, which press in by what they may.
    const double part = blocks.is_movable(a) || blocks.is_movable(b) ? deepest_overlap : coincidence,
                 limit = part * std::min(blocks.block(a).size(), blocks.block(b).size()),
                 now = depth(blocks, end, a, b);
    if (now > limit && now > std::max(0.0, depth(blocks, blocks.drawn(), a, b)) + limit &&
        !gives_way({std::min(a, b), std::max(a, b)}))
      return Pair{a, b};
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
