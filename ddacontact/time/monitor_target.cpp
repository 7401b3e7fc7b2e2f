#include <ddacontact/time/monitor_target.hpp>

namespace ddacontact {

namespace {

Motion observe_target(const MaterialPoint& point, const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  return {blocks.interpolate(point, blocks.positions(stepper.state())),
          blocks.interpolate(point, blocks.displacements(stepper.state())),
          blocks.displacement(point, stepper.state().velocity)};
}

Motion observe_target(const Centroid& centroid, const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  const Block& block = blocks.block(centroid.block);
  const BlockState& state = stepper.state();
  const Vec2 x = block.centroid(state);
  const BlockState& zero = blocks.displacement_zero();
  const Vec2 start = zero.origin.col(centroid.block) + block.moments(zero).centroid;
  return {x, x - start, rigid_velocity(block, state, state.velocity).linear};
}

}  // namespace

Motion observe(const MonitorTarget& monitor, const Stepper& stepper) {
  return std::visit([&](const auto& point) { return observe_target(point, stepper); }, monitor.target);
}

}  // namespace ddacontact
