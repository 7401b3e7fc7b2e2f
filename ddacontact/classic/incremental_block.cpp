#include <ddacontact/classic/incremental_block.hpp>

#include <cassert>

namespace ddacontact {

void IncrementalBlock::begin_step(const BlockState& state, const StepStart& start) {
  const Range& u = unknowns();
  assert(start.dt > 0 && start.velocity.size() >= u.end());
  if (start.rule.has_half_steps() || start.rule.mean_forces())
    throw Error("blocks with incremental kinematics need the scheme dda, newmark or backward_euler");
  rule_ = start.rule;
  dt_ = start.dt;
  velocity_ = u.of(start.velocity);
  acceleration_ = u.of(start.acceleration);
  path_ = dt_ * velocity_;
  VectorXd F = VectorXd::Zero(u.end());
  add_stress_forces(state, F);
  stress_forces_ = -u.of(F);
}

void IncrementalBlock::forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const {
  forces.resize(n_unknowns());
  const VectorXd Kd = stiffness_ * d;
  forces.elastic = stress_forces_ + Kd;
  forces.damping = rule_.damping.stiffness / dt_ * Kd + rule_.damping.mass / dt_ * (mass_ * d);
  forces.inertia = mass_ * (rule_.inertia() / (dt_ * dt_) * (d - path_) - rule_.history() * acceleration_);
}

void IncrementalBlock::tangent(const Eigen::Ref<const VectorXd>&, std::span<MatrixXd> parts) const {
  parts[0] = (1 + rule_.damping.stiffness / dt_) * stiffness_ +
             (rule_.inertia() / (dt_ * dt_) + rule_.damping.mass / dt_) * mass_;
}

void IncrementalBlock::end_step(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>&, bool,
                                BlockState& next) const {
  const Range &u = unknowns(), &v = vertices();
  VectorXd all = VectorXd::Zero(u.end());
  u.of(all) = d;
  for (int k = 0; k < v.count; ++k) next.position.col(v.first + k) += vertex_map(k)(all);
  add_stress(all, next.stress);
  const VectorXd acceleration = rule_.inertia() / (dt_ * dt_) * (d - path_) - rule_.history() * acceleration_;
  u.of(next.velocity) = velocity_ + dt_ * ((1 - rule_.gamma) * acceleration_ + rule_.gamma * acceleration);
  u.of(next.carried) = acceleration;
  follow_with_origin(next);
}

double IncrementalBlock::stored_energy(const Eigen::Ref<const VectorXd>& d) const {
  return d.dot(stress_forces_) + d.dot(stiffness_ * d) / 2;
}

}  // namespace ddacontact
