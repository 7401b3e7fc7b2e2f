#include <ddacontact/time/half_steps.hpp>

#include <ddacontact/block/rigid_velocity.hpp>

namespace ddacontact {

VectorXd velocity_between(const BlockSystem& blocks, const BlockState& state, const VectorXd& after,
                          double dt, const VectorXd* external) {
  const double before = state.carried_dt;
  VectorXd velocity = (dt * state.carried + before * after) / (dt + before);
  for (int b = 0; external && b < blocks.n_blocks(); ++b) {
    if (!blocks.is_free(b)) continue;
    const Block& block = blocks.block(b);
    const Range& u = block.unknowns();
    const auto forces = external->segment(u.first, u.count);
    const double inertia = block.rotation().dot(block.times_mass(block.rotation()).col(0));
    const RigidVelocity carried = rigid_velocity(block, state.carried),
                        found = rigid_velocity(block, velocity);
    const Vec2 linear =
        carried.linear + before / 2 * block.translations().transpose() * forces / block.mass_total();
    const double angular = carried.angular + before / 2 * block.rotation().dot(forces) / inertia;
    velocity.segment(u.first, u.count) +=
        block.translations() * (linear - found.linear) + block.rotation() * (angular - found.angular);
  }
  return velocity;
}

}  // namespace ddacontact
