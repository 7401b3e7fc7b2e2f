#include <ddacontact/block/system_part.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace ddacontact {

namespace {

void append(const Range& range, std::vector<int>& numbers) {
  for (int k = range.first; k < range.end(); ++k) numbers.push_back(k);
}

std::vector<std::unique_ptr<Block>> copies(const BlockSystem& whole, const std::vector<int>& of) {
  std::vector<std::unique_ptr<Block>> blocks;
  for (int b : of) blocks.push_back(whole.block(b).copy());
  return blocks;
}

}  // namespace

BlockSystem::Part::Part(const BlockSystem& whole, std::vector<int> blocks, const std::vector<char>& resting)
    : blocks_(std::move(blocks)), system_(copies(whole, blocks_)) {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const int b = blocks_[k];
    const Block& block = whole.block(b);
    append(block.points(), points_);
    append(block.unknowns(), unknowns_);
    append(block.stress_points(), stress_points_);
    append(block.coordinates(), coordinates_);
    system_.names[k] = whole.names[b];
    system_.resting_[k] = resting[b] != 0;
    if (whole.has_rounded_corners()) system_.rounded_.push_back(whole.rounded(b));
  }
  system_.computes_fixed_ = whole.computes_fixed_;
  take_starts(whole);
  take_actions(whole);
  take_bolts(whole);
  system_.number_equations();
}

void BlockSystem::Part::take_starts(const BlockSystem& whole) {
  const auto take = [&](const BlockState& all, BlockState& own) {
    own.position = all.position(Eigen::all, points_);
    own.origin = all.origin(Eigen::all, blocks_);
  };
  take(whole.start_, system_.start_);
  if (whole.zero_.position.size() > 0) take(whole.zero_, system_.zero_);
}

void BlockSystem::Part::take_actions(const BlockSystem& whole) {
  const auto number_where_moving = [&](int block) {
    const int k = number_of(block);
    return k >= 0 && !is_resting(k) ? k : -1;
  };
  const auto take = [&](auto& own, const auto& all) {
    for (auto action : all) {
      int& block = BlockActions::block_of(action);
      block = number_where_moving(block);
      if (block >= 0) own.push_back(std::move(action));
    }
  };
  system_.for_lists(whole, take);
  take(system_.water.faces, whole.water.faces);
  system_.water.water = whole.water.water;
  system_.ground = whole.ground;
  for (PrescribedDof held : whole.prescribed_dofs_)
    if (const int k = number_where_moving(whole.block_of_point_[held.vertex]); k >= 0) {
      const Block &own = system_.block(k), &same = whole.block(blocks_[k]);
      held.unknown += own.unknowns().first - same.unknowns().first;
      held.vertex += own.points().first - same.points().first;
      system_.prescribed_dofs_.push_back(std::move(held));
    }
  if (whole.fading.forces.size() == 0) return;
  system_.fading = {whole.fading.forces(unknowns_), whole.fading.from, whole.fading.to};
  for (int k = 0; k < system_.n_blocks(); ++k)
    if (is_resting(k)) system_.block(k).unknowns().of(system_.fading.forces).setZero();
}

void BlockSystem::Part::take_bolts(const BlockSystem& whole) {
  std::vector<Bolt> bolts;
  for (Bolt bolt : whole.bolts) {
    bool all_inside = acts(bolt, whole);
    for (MaterialPoint& node : bolt.nodes) {
      if (node.block < 0) continue;
      node.block = number_of(node.block);
      all_inside = all_inside && node.block >= 0;
    }
    if (!all_inside) continue;
    append(bolt.numbers, bolt_numbers_);
    bolts.push_back(std::move(bolt));
  }
  system_.set_bolts(std::move(bolts));
}

int BlockSystem::Part::number_of(int block) const {
  const auto found = std::ranges::lower_bound(blocks_, block);
  return found != blocks_.end() && *found == block ? static_cast<int>(found - blocks_.begin()) : -1;
}

template <class Whole, class Own, class Move>
void BlockSystem::Part::for_arrays(Whole& whole, Own& part, const Move& move) const {
  // Spans: an indexed view keeps a copy of what it is indexed by.
  using Numbers = std::span<const int>;
  const Numbers blocks = blocks_, points = points_, unknowns = unknowns_;
  const auto if_any = [](const auto& array, Numbers numbers) {
    return array.size() > 0 ? numbers : Numbers();
  };
  move(whole.time, part.time);
  move(whole.carried_dt, part.carried_dt);
  move(whole.origin(Eigen::all, blocks), part.origin);
  move(whole.rotation(blocks), part.rotation);
  move(whole.position(Eigen::all, points), part.position);
  move(whole.velocity(unknowns), part.velocity);
  move(whole.carried(unknowns), part.carried);
  move(whole.coordinates(if_any(whole.coordinates, coordinates_)), part.coordinates);
  move(whole.stress(Eigen::all, if_any(whole.stress, stress_points_)), part.stress);
  move(whole.bolts(Numbers(bolt_numbers_)), part.bolts);
}

/// Block b of one becomes block k of the other where its matrices follow the shape that steps have given it.
void BlockSystem::Part::pass_shape(const BlockSystem& from, int b, BlockSystem& to, int k) {
  if (!from.block(b).follows_shape()) return;
  const Block& same = to.block(k);
  std::unique_ptr<Block> copy = from.block(b).copy();
  copy->number(k, same.points().first, same.unknowns().first, same.stress_points().first,
               same.coordinates().first);
  to.blocks_[k] = std::move(copy);
}

void BlockSystem::Part::read(const BlockSystem& whole, const BlockState& state) {
  system_.gravity = whole.gravity;
  system_.end_time = whole.end_time;
  for_arrays(state, state_, [](const auto& of_whole, auto& of_part) { of_part = of_whole; });
  for (int k = 0; k < system_.n_blocks(); ++k) pass_shape(whole, blocks_[k], system_, k);
}

void BlockSystem::Part::write(BlockSystem& whole, BlockState& state) const {
  for_arrays(state, state_, [](auto&& of_whole, const auto& of_part) { of_whole = of_part; });
  for (int k = 0; k < system_.n_blocks(); ++k)
    if (!is_resting(k)) pass_shape(system_, k, whole, blocks_[k]);
}

}  // namespace ddacontact
