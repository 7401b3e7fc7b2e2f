#include <ddacontact/block/rigid_velocity.hpp>

namespace ddacontact {

RigidVelocity rigid_velocity(const Block& block, const VectorXd& velocity) {
  const auto modes = block.rigid_modes();
  const MatrixXd weighted = block.times_mass(modes);  // the momenta of unit motions, by unknown
  const Vec3 momentum = weighted.transpose() * block.unknowns().of(velocity);
  const Vec3 inertia = (modes.transpose() * weighted).diagonal();
  return {momentum.head<2>().cwiseQuotient(inertia.head<2>()), momentum[2] / inertia[2]};
}

VectorXd as_velocity(const Block& block, const RigidVelocity& rigid) {
  return block.rigid_modes() * Vec3(rigid.linear.x(), rigid.linear.y(), rigid.angular);
}

}  // namespace ddacontact
