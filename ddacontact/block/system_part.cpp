#include <ddacontact/block/system_part.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace ddacontact {

namespace {

void append(const Range& range, std::vector<int>& numbers) {
  for (int k = range.first; k < range.end(); ++k) numbers.push_back(k);
}

}  // namespace

BlockSystem::Part::Part(BlockSystem& whole, std::vector<int> blocks, const std::vector<char>& resting)
    : blocks_(std::move(blocks)) {
  number_blocks(whole, resting);
  take_starts(whole);
  take_actions(whole);
  take_bolts(whole);
  system_.blocks_.resize(blocks_.size());
  pass_blocks(whole, in_whole_, system_, in_part_);
  system_.number_equations();
  pass_blocks(system_, in_part_, whole, in_whole_);
}

void BlockSystem::Part::number_blocks(const BlockSystem& whole, const std::vector<char>& resting) {
  const auto size = [](const std::vector<int>& numbers) { return static_cast<int>(numbers.size()); };
  for (int b : blocks_) {
    const Block& block = whole.block(b);
    const auto k = static_cast<int>(in_part_.size());
    in_whole_.push_back({b, block.points().first, block.unknowns().first, block.stress_points().first,
                         block.coordinates().first});
    in_part_.push_back({k, size(points_), size(unknowns_), size(stress_points_), size(coordinates_)});
    append(block.points(), points_);
    append(block.unknowns(), unknowns_);
    append(block.stress_points(), stress_points_);
    append(block.coordinates(), coordinates_);
    system_.block_of_point_.resize(points_.size(), k);
    system_.block_of_unknown_.resize(unknowns_.size(), k);
    resting_.push_back(resting[b] != 0);
    system_.names.push_back(whole.names[b]);
    if (whole.has_rounded_corners()) system_.rounded_.push_back(whole.rounded(b));
  }
  system_.n_unknowns_ = size(unknowns_);
  system_.n_stress_points_ = size(stress_points_);
  system_.n_coordinates_ = size(coordinates_);
  system_.present_.assign(blocks_.size(), true);
  system_.resting_ = resting_;
  system_.computes_fixed_ = whole.computes_fixed_;
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
    return k >= 0 && !resting_[k] ? k : -1;
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
      held.unknown += in_part_[k].unknown - in_whole_[k].unknown;
      held.vertex += in_part_[k].point - in_whole_[k].point;
      system_.prescribed_dofs_.push_back(std::move(held));
    }
  if (whole.fading.forces.size() == 0) return;
  system_.fading = {whole.fading.forces(unknowns_), whole.fading.from, whole.fading.to};
  for (int u = 0; u < system_.n_unknowns_; ++u)
    if (resting_[system_.block_of_unknown_[u]]) system_.fading.forces[u] = 0;
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

void BlockSystem::Part::pass_blocks(BlockSystem& from, const std::vector<Place>& here, BlockSystem& to,
                                    const std::vector<Place>& there) {
  for (std::size_t k = 0; k < here.size(); ++k) {
    const Place& at = there[k];
    to.blocks_[at.block] = std::move(from.blocks_[here[k].block]);
    to.blocks_[at.block]->number(at.block, at.point, at.unknown, at.stress_point, at.coordinate);
  }
}

template <class Move>
void BlockSystem::Part::for_arrays(BlockState& whole, BlockState& part, const Move& move) const {
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

void BlockSystem::Part::put_in(BlockSystem& system, BlockState& state) {
  system_.gravity = system.gravity;
  system_.end_time = system.end_time;
  for_arrays(state, state_, [](const auto& of_whole, auto& of_part) { of_part = of_whole; });
  pass_blocks(system, in_whole_, system_, in_part_);
  std::swap(system, system_);
  std::swap(state, state_);
}

void BlockSystem::Part::take_out(BlockSystem& system, BlockState& state) {
  std::swap(system, system_);
  std::swap(state, state_);
  pass_blocks(system_, in_part_, system, in_whole_);
  for_arrays(state, state_, [](auto&& of_whole, const auto& of_part) { of_whole = of_part; });
}

}  // namespace ddacontact
