#include <ddacontact/block/bolt.hpp>

#include <ddacontact/block/block_system.hpp>

namespace ddacontact {

bool acts(const Bolt& bolt, const BlockSystem& blocks) {
  const auto moves = [&](int node) { return !blocks.is_unchanging(bolt.nodes[node].block); };
  for (int k = 0; bolt.installed && k < bolt.n_segments(); ++k)
    if (bolt.has_segment(k) && (moves(k) || moves(k + 1))) return true;
  return false;
}

Vec2 segment_vector(const Bolt& bolt, int segment, const BlockSystem& blocks, const BlockState& state) {
  const MaterialPoint &from = bolt.nodes[segment], &to = bolt.nodes[segment + 1];
  const Vec2 shift = state.origin.col(to.block) - state.origin.col(from.block);
  return blocks.interpolate(to, state.position) - blocks.interpolate(from, state.position) + shift;
}

VectorXd elongations(const Bolt& bolt, const BlockSystem& blocks, const BlockState& state) {
  VectorXd changes = VectorXd::Zero(bolt.n_segments());
  for (int k = 0; k < bolt.n_segments(); ++k)
    if (bolt.has_segment(k))
      changes[k] =
          segment_vector(bolt, k, blocks, state).norm() - state.bolts[bolt.numbers.first + Bolt::length(k)];
  return changes;
}

void install(const Bolt& bolt, const BlockSystem& blocks, BlockState& state) {
  auto numbers = bolt.numbers.of(state.bolts);
  numbers.setZero();
  for (int k = 0; k < bolt.n_segments(); ++k) {
    if (!bolt.has_segment(k)) continue;
    const double length = segment_vector(bolt, k, blocks, state).norm();
    numbers[Bolt::length(k)] = length;
    numbers[Bolt::plastic(k)] = -bolt.pretension * length / bolt.stiffness;
  }
}

}  // namespace ddacontact
