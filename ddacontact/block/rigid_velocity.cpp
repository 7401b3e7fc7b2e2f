#include <ddacontact/block/rigid_velocity.hpp>

namespace ddacontact {

RigidVelocity rigid_velocity(const Block& block, const BlockState& state, const VectorXd& velocity) {
  return rigid_velocity_by(block, state, block.times_mass(block.unknowns().of(velocity)).col(0));
}

RigidVelocity rigid_velocity_by(const Block& block, const BlockState& state, const VectorIn& momenta) {
  const auto modes = block.rigid_modes(state);
  const Vec3 momentum = modes.transpose() * momenta,
             inertia = (modes.transpose() * block.times_mass(modes)).diagonal();
  return {momentum.head<2>().cwiseQuotient(inertia.head<2>()), momentum[2] / inertia[2]};
}

VectorXd as_velocity(const Block& block, const BlockState& state, const RigidVelocity& rigid) {
  return block.rigid_modes(state) * Vec3(rigid.linear.x(), rigid.linear.y(), rigid.angular);
}

}  // namespace ddacontact
