#include <ddacontact/classic/incremental_block.hpp>

#include <cassert>

namespace ddacontact {

namespace {

class IncrementalStep final : public BlockStep {
 public:
  IncrementalStep(const IncrementalBlock& block, const BlockState& state, const StepStart& start)
      : block_(block), rule_(start.rule), dt_(start.dt) {
    const Range& u = block.unknowns();
    assert(dt_ > 0 && start.velocity.size() >= u.end());
    velocity_ = u.of(start.velocity);
    acceleration_ = u.of(start.acceleration);
    path_ = dt_ * velocity_;
    VectorXd F = VectorXd::Zero(u.end());
    block.add_stress_forces(state, F);
    stress_forces_ = -u.of(F);
  }

  void free_path(VectorOut path) const override { path = path_; }

  void forces(const VectorIn& d, BlockForces& forces) const override {
    forces.resize(block_.n_unknowns());
    const VectorXd Kd = block_.stiffness() * d;
    forces.elastic() = stress_forces_ + Kd;
    forces.damping() =
        rule_.damping.stiffness / dt_ * Kd + rule_.damping.mass / dt_ * (block_.mass_matrix() * d);
    forces.inertia() = block_.mass_matrix() * acceleration_after(d);
  }

  void tangent(const VectorIn&, std::span<MatrixXd> parts) const override {
    parts[0] = (1 + rule_.damping.stiffness / dt_) * block_.stiffness() +
               (rule_.inertia() / (dt_ * dt_) + rule_.damping.mass / dt_) * block_.mass_matrix();
  }

  void end(const VectorIn& d, const VectorIn&, bool, BlockState& next) const override {
    const Range &u = block_.unknowns(), &v = block_.vertices();
    VectorXd all = VectorXd::Zero(u.end());
    u.of(all) = d;
    for (int k = 0; k < v.count; ++k) next.position.col(v.first + k) += block_.vertex_map(k)(all);
    block_.add_stress(all, next.stress);
    const VectorXd acceleration = acceleration_after(d);
    u.of(next.velocity) = velocity_ + dt_ * ((1 - rule_.gamma) * acceleration_ + rule_.gamma * acceleration);
    u.of(next.carried) = acceleration;
    block_.follow_with_origin(next);
  }

  double stored_energy(const VectorIn& d) const override {
    return d.dot(stress_forces_) + d.dot(block_.stiffness() * d) / 2;
  }

 private:
  VectorXd acceleration_after(const VectorIn& d) const {
    return rule_.inertia() / (dt_ * dt_) * (d - path_) - rule_.history() * acceleration_;
  }

  const IncrementalBlock& block_;
  StepRule rule_;
  double dt_;
  VectorXd velocity_, acceleration_, path_;  ///< path_: displacements without forces
  VectorXd stress_forces_;                   ///< integral of B^T sigma at the start of the step
};

}  // namespace

std::unique_ptr<Block> IncrementalBlock::reshaped(const BlockState& state) const {
  std::unique_ptr<Block> block = copy();
  static_cast<IncrementalBlock&>(*block).take_shape(outline(state));
  return block;
}

void IncrementalBlock::begin_step(const BlockState& state, const StepStart& start,
                                  std::unique_ptr<BlockStep>& step) const {
  if (start.rule.has_half_steps() || start.rule.mean_forces())
    throw Error("blocks with incremental kinematics need the scheme dda, newmark or backward_euler");
  step = std::make_unique<IncrementalStep>(*this, state, start);
}

}  // namespace ddacontact
