#include <ddacontact/block/system_part.hpp>

#include <algorithm>
#include <utility>

namespace ddacontact {

SystemPart::SystemPart(BlockSystem& whole, std::vector<int> blocks, const std::vector<char>& resting)
    : blocks_(std::move(blocks)) {
  number_blocks(whole, resting);
  take_starts(whole);
  take_actions(whole);
  take_bolts(whole);

  state_.position.resize(2, system_.start_.position.cols());
  state_.origin.resize(2, system_.start_.origin.cols());
  state_.velocity.resize(system_.n_unknowns_);
  state_.carried.resize(system_.n_unknowns_);
  state_.rotation.resize(system_.start_.origin.cols());

  system_.blocks_.resize(blocks_.size());
  lend(whole, system_);
  system_.number_equations();
  give_back(system_, whole);
}

void SystemPart::number_blocks(const BlockSystem& whole, const std::vector<char>& resting) {
  Ranges next;
  for (int b : blocks_) {
    const Block& block = whole.block(b);
    in_whole_.push_back({block.points(), block.unknowns(), block.stress_points(), block.coordinates()});
    in_part_.push_back({{next.points.first, block.n_points()},
                        {next.unknowns.first, block.n_unknowns()},
                        {next.stress_points.first, block.n_stress_points()},
                        {next.coordinates.first, block.n_coordinates()}});
    for (int u = block.unknowns().first; u < block.unknowns().end(); ++u) unknowns_.push_back(u);
    next = {{in_part_.back().points.end(), 0},
            {in_part_.back().unknowns.end(), 0},
            {in_part_.back().stress_points.end(), 0},
            {in_part_.back().coordinates.end(), 0}};
    const auto k = static_cast<int>(resting_.size());
    system_.block_of_point_.insert(system_.block_of_point_.end(), block.n_points(), k);
    system_.block_of_unknown_.insert(system_.block_of_unknown_.end(), block.n_unknowns(), k);
    resting_.push_back(resting[b] != 0);
    system_.names.push_back(whole.names[b]);
    if (whole.has_rounded_corners()) system_.rounded_.push_back(whole.rounded(b));
  }
  system_.n_unknowns_ = next.unknowns.first;
  system_.n_stress_points_ = next.stress_points.first;
  system_.n_coordinates_ = next.coordinates.first;
  system_.present_.assign(blocks_.size(), true);
  system_.resting_ = resting_;
  system_.computes_fixed_ = whole.computes_fixed_;
}

void SystemPart::take_starts(const BlockSystem& whole) {
  const auto take = [&](const BlockState& all, BlockState& own) {
    own.position.resize(2, static_cast<Index>(system_.block_of_point_.size()));
    own.origin = all.origin(Eigen::all, blocks_);
    for (std::size_t k = 0; k < blocks_.size(); ++k) {
      const Range &from = in_whole_[k].points, &to = in_part_[k].points;
      own.position.middleCols(to.first, to.count) = all.position.middleCols(from.first, from.count);
    }
  };
  take(whole.start_, system_.start_);
  if (whole.zero_.position.size() > 0) take(whole.zero_, system_.zero_);
}

void SystemPart::take_actions(const BlockSystem& whole) {
  const auto number_where_moving = [&](int block) {
    const int k = number_of(block);
    return k >= 0 && !resting_[k] ? k : -1;
  };
  const auto take = [&](const auto& all, auto& own, const auto& block_of) {
    for (auto action : all)
      if (const int k = number_where_moving(block_of(action)); k >= 0) {
        block_of(action) = k;
        own.push_back(std::move(action));
      }
  };
  const auto block = [](auto& action) -> int& { return action.block; };
  take(whole.point_loads, system_.point_loads, [](PointLoad& load) -> int& { return load.point.block; });
  take(whole.pressure_loads, system_.pressure_loads, block);
  take(whole.body_loads, system_.body_loads, block);
  take(whole.water.faces, system_.water.faces, block);
  take(whole.quiet_faces, system_.quiet_faces, block);
  take(whole.fixed_vertices, system_.fixed_vertices, block);
  system_.water.water = whole.water.water;
  system_.ground = whole.ground;
  for (PrescribedDof held : whole.prescribed_dofs_)
    if (const int k = number_where_moving(whole.block_of_point_[held.vertex]); k >= 0) {
      held.unknown += in_part_[k].unknowns.first - in_whole_[k].unknowns.first;
      held.vertex += in_part_[k].points.first - in_whole_[k].points.first;
      system_.prescribed_dofs_.push_back(std::move(held));
    }
  if (whole.fading.forces.size() == 0) return;
  system_.fading = {VectorXd::Zero(system_.n_unknowns_), whole.fading.from, whole.fading.to};
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    if (const Range& to = in_part_[k].unknowns, &from = in_whole_[k].unknowns; !resting_[k])
      system_.fading.forces.segment(to.first, to.count) = whole.fading.forces.segment(from.first, from.count);
}

void SystemPart::take_bolts(const BlockSystem& whole) {
  std::vector<Bolt> bolts;
  for (Bolt bolt : whole.bolts) {
    bool all_inside = acts(bolt, whole);
    for (MaterialPoint& node : bolt.nodes) {
      if (node.block < 0) continue;
      node.block = number_of(node.block);
      all_inside = all_inside && node.block >= 0;
    }
    if (!all_inside) continue;
    bolts_in_whole_.push_back(bolt.numbers);
    bolts.push_back(std::move(bolt));
  }
  system_.set_bolts(std::move(bolts));
  for (const Bolt& bolt : system_.bolts) bolts_in_part_.push_back(bolt.numbers);
}

int SystemPart::number_of(int block) const {
  const auto found = std::lower_bound(blocks_.begin(), blocks_.end(), block);
  return found != blocks_.end() && *found == block ? static_cast<int>(found - blocks_.begin()) : -1;
}

void SystemPart::lend(BlockSystem& whole, BlockSystem& part) const {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Ranges& to = in_part_[k];
    part.blocks_[k] = std::move(whole.blocks_[blocks_[k]]);
    part.blocks_[k]->number(static_cast<int>(k), to.points.first, to.unknowns.first, to.stress_points.first,
                            to.coordinates.first);
  }
}

void SystemPart::give_back(BlockSystem& part, BlockSystem& whole) const {
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Ranges& to = in_whole_[k];
    const int b = blocks_[k];
    whole.blocks_[b] = std::move(part.blocks_[k]);
    whole.blocks_[b]->number(b, to.points.first, to.unknowns.first, to.stress_points.first,
                             to.coordinates.first);
  }
}

void SystemPart::copy(const BlockState& from, const std::vector<Ranges>& in_from, BlockState& to,
                      const std::vector<Ranges>& in_to, bool into_part) const {
  to.time = from.time;
  to.carried_dt = from.carried_dt;
  const bool stressed = from.stress.cols() > 0, by_motions = from.coordinates.size() > 0;
  if (into_part) to.coordinates.resize(by_motions ? system_.n_coordinates_ : 0);
  if (into_part) to.stress.resize(3, stressed ? system_.n_stress_points_ : 0);
  if (into_part) to.bolts.resize(system_.bolts.empty() ? 0 : system_.bolts.back().numbers.end());
  for (std::size_t k = 0; k < bolts_in_part_.size(); ++k) {
    const Range &part = bolts_in_part_[k], &whole = bolts_in_whole_[k];
    if (into_part)
      to.bolts.segment(part.first, part.count) = from.bolts.segment(whole.first, whole.count);
    else
      to.bolts.segment(whole.first, whole.count) = from.bolts.segment(part.first, part.count);
  }
  for (std::size_t k = 0; k < blocks_.size(); ++k) {
    const Ranges &source = in_from[k], &target = in_to[k];
    const Index here = into_part ? blocks_[k] : static_cast<Index>(k),
                there = into_part ? static_cast<Index>(k) : blocks_[k];
    to.origin.col(there) = from.origin.col(here);
    to.rotation[there] = from.rotation[here];
    to.position.middleCols(target.points.first, target.points.count) =
        from.position.middleCols(source.points.first, source.points.count);
    if (by_motions)
      to.coordinates.segment(target.coordinates.first, target.coordinates.count) =
          from.coordinates.segment(source.coordinates.first, source.coordinates.count);
    to.velocity.segment(target.unknowns.first, target.unknowns.count) =
        from.velocity.segment(source.unknowns.first, source.unknowns.count);
    to.carried.segment(target.unknowns.first, target.unknowns.count) =
        from.carried.segment(source.unknowns.first, source.unknowns.count);
    if (stressed)
      to.stress.middleCols(target.stress_points.first, target.stress_points.count) =
          from.stress.middleCols(source.stress_points.first, source.stress_points.count);
  }
}

void SystemPart::put_in(BlockSystem& system, BlockState& state) {
  system_.gravity = system.gravity;
  system_.end_time = system.end_time;
  copy(state, in_whole_, state_, in_part_, true);
  lend(system, system_);
  std::swap(system, system_);
  std::swap(state, state_);
}

void SystemPart::take_out(BlockSystem& system, BlockState& state) {
  std::swap(system, system_);
  std::swap(state, state_);
  give_back(system_, system);
  copy(state_, in_part_, state, in_whole_, false);
}

}  // namespace ddacontact
