#include <ddacontact/time/probe.hpp>

namespace ddacontact {

namespace {

Motion observe_place(const MaterialPoint& point, const Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  const Vec2 x = blocks.position(point, stepper.state().position);
  return {x, blocks.position(point, stepper.state().position - blocks.reference()),
          blocks.displacement(point, stepper.state().velocity)};
}

Motion observe_place(const Centroid& centroid, const Stepper& stepper) {
  const Block& block = stepper.blocks().block(centroid.block);
  const Range& v = block.vertices();
  const Vec2 x = block.moments().centroid;
  const Vec2 start = polyfem::area_moments(stepper.blocks().reference().middleCols(v.first, v.count)).centroid;
  return {x, x - start, rigid_velocity(block, stepper.state().velocity).linear};
}

}  // namespace

Motion observe(const Probe& probe, const Stepper& stepper) {
  return std::visit([&](const auto& place) { return observe_place(place, stepper); }, probe.place);
}

RigidVelocity rigid_velocity(const Block& block, const VectorXd& velocity) {
  const auto& modes = block.rigid_modes();
  const MatrixXd weighted = block.mass() * modes;  // the momenta of unit motions, by unknown
  const Vec3 momentum = weighted.transpose() * velocity.segment(block.unknowns().first, block.unknowns().count);
  const Vec3 inertia = (modes.transpose() * weighted).diagonal();
  return {momentum.head<2>().cwiseQuotient(inertia.head<2>()), momentum[2] / inertia[2]};
}

}  // namespace ddacontact
