/// \file The forces and the end of a step of a corotational block, by its nodes.
#pragma once

#include <ddacontact/block/corotational_motion.hpp>
#include <polyfem/element/matrices.hpp>

#include <cmath>
#include <span>
#include <vector>

namespace ddacontact {

/// A step that was begun. Its arrays hold the positions of the nodes, their velocities and accelerations
/// (Newmark's); of each cell the first axis of its frame, (stretch, 0) and the positions of its nodes there;
/// and where there is any, the forces on the nodes of each cell of the stress that the reference shape has.
template <class Of>
class CorotationalStep final : public BlockStep {
 public:
  using Nodes = NodalKinematics<Of>;
  using Vectors = typename Of::Vectors;
  using Stacked = typename Of::Stacked;
  using Frame = polyfem::CorotatedFrameOf<Of>;

  /// Keeps references.
  CorotationalStep(const Block& block, const CorotationalShape& shape) : block_(block), nodes_(shape) {}

  /// Begins a step.
  void begin(const StepRule& rule, double dt, const Vectors& y, const Vectors& velocity,
             const Vectors& acceleration, const TensorsRef& initial_stress) {
    if (!matrices_ || !matrices_->are_for(rule, dt)) matrices_ = step_matrices(nodes_.shape(), rule, dt);
    y0_ = y;
    velocity_ = velocity;
    acceleration_ = acceleration;
    frames_.clear();
    initial_forces_.clear();
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const ShapeCell& cell = nodes_.shape().cells[c];
      frames_.push_back(nodes_.frame(y, c));
      Stacked& force = initial_forces_.emplace_back(Stacked::Zero(2 * cell.elastic.n_nodes()));
      if (initial_stress.isZero(0)) continue;
      polyfem::stress_forces(cell.element,
                             initial_stress.middleCols(cell.first_point, cell.element.n_points()), force);
    }
  }

  void forces(const VectorIn& d, BlockForces& forces) const override {
    const Vectors step = nodes_.to_nodes(d), y1 = y0_ + step;
    Vectors elastic = Vectors::Zero(2, step.cols()), damping = elastic;
    if (rule().damping.mass != 0) damping = rule().damping.mass / dt() * nodes_.weighted(step);
    Stacked f, damped;
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const polyfem::CorotatedElement& element = nodes_.shape().cells[c].elastic;
      const Frame &start = frames_[c], to = nodes_.frame(y1, c), &from = rule().mean_forces() ? start : to;
      element.mean_force(from, to, 0, initial_forces_[c], f);
      nodes_.add_of_cell(f, c, elastic);
      if (rule().damping.stiffness == 0) continue;
      const Stacked rate = element.template times_stiffness<Of>(to.u - start.u);
      element.mean_force(from, to, 0, initial_forces_[c] + rule().damping.stiffness / dt() * rate, damped);
      nodes_.add_of_cell(damped - f, c, damping);
    }
    forces.resize(d.size());
    nodes_.forces_on_unknowns(elastic, forces.elastic());
    nodes_.forces_on_unknowns(nodes_.weighted(acceleration_after(step)), forces.inertia());
    nodes_.forces_on_unknowns(damping, forces.damping());
  }

  void tangent(const VectorIn& d, std::span<MatrixXd> parts) const override {
    const Vectors y1 = y0_ + nodes_.to_nodes(d);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const ShapeCell& cell = nodes_.shape().cells[c];
      Mat2 rotation = nodes_.cell_rotation(y1, c);
      if (rule().directions() != Directions::of_end)
        rotation = polyfem::mid_rotation(frames_[c].rotation, rotation);
      polyfem::rotate(matrices_->tangents[c], rotation, parts[c]);
      const MatrixXd& B = cell.nodes_by_unknowns;
      if (B.size() > 0) parts[c] = (B.transpose() * parts[c] * B).eval();
    }
  }

  void add_change(const VectorIn& change, VectorOut d) const override {
    const Vectors y = y0_ + nodes_.to_nodes(d), way = nodes_.to_nodes(change);
    const typename Nodes::Rigid rigid = nodes_.rigid(y, way);
    const Vectors shift = nodes_.everywhere(rigid.linear),
                  strain = way - shift - rigid.angular * rigid.turning;
    const Mat2 turn = turned_by(rigid.angular) - Mat2::Identity();
    const Vectors moved = turn * (nodes_.arms(y) + strain) + strain + shift;
    Stacked of_unknowns(d.size());
    nodes_.to_unknowns(moved, of_unknowns);
    d += of_unknowns;
  }

  void free_path(VectorOut path) const override {
    const typename Nodes::Rigid motion = nodes_.rigid(y0_, velocity_);
    const Mat2 turn = turned_by(2 * std::atan(dt() * motion.angular / 2));
    const Vectors r = nodes_.arms(y0_);
    nodes_.to_unknowns(turn * r - r + nodes_.everywhere(dt() * motion.linear), path);
  }

  void end(const VectorIn& d, const VectorIn& external, bool is_free, BlockState& next) const override {
    const Vectors moved = nodes_.to_nodes(d);
    nodes_.put_points(y0_ + moved, block_.points().columns_of(next.position));
    End end = this->end(moved);
    if (is_free) keep_momenta(moved, external, end);
    nodes_.to_unknowns(end.velocity, block_.unknowns().of(next.velocity));
    nodes_.to_unknowns(end.acceleration, block_.unknowns().of(next.carried));
    block_.follow_with_origin(next);
  }
  /// Velocity and acceleration of the nodes after the step.
  struct End {
    Vectors velocity, acceleration;
  };
  End end(const Vectors& step) const {
    End end;
    end.acceleration = acceleration_after(step);
    end.velocity = velocity_;
    if (keeps_acceleration(rule())) end.velocity += dt() * (1 - rule().gamma) * acceleration_;
    end.velocity += dt() * rule().gamma * end.acceleration;
    return end;
  }

  /// Gives a free block the momentum that forces of its unknowns have given it, instead of what is left of
  /// it after K d has cancelled; by forces at the middle its angular momentum as well.
  void keep_momenta(const Vectors& step, const VectorIn& external, End& end) const {
    const auto work = [&](const Vectors& motion) {
      const double damped = rule().damping.mass == 0 ? 0
                                                     : rule().damping.mass / dt() *
                                                           nodes_.weighted(step).cwiseProduct(motion).sum();
      return nodes_.work(external, motion) - damped;
    };
    const Vec2 force(work(nodes_.everywhere(Vec2::UnitX())), work(nodes_.everywhere(Vec2::UnitY())));
    const Vec2 by_force = force / nodes_.shape().mass_total;
    const typename Nodes::Rigid before = nodes_.rigid(y0_, velocity_),
                                after = nodes_.rigid(y0_ + step, end.velocity);
    Vec2 linear = before.linear + dt() * rule().gamma * by_force;
    if (keeps_acceleration(rule())) linear += dt() * (1 - rule().gamma) * nodes_.mean(acceleration_);
    end.velocity += nodes_.everywhere(linear - after.linear);
    if (rule().history() != 0)
      end.acceleration += nodes_.everywhere(by_force - nodes_.mean(end.acceleration));
    if (rule().mean_forces()) {
      const double torque = work(nodes_.spin(y0_ + step / 2));
      const double angular = (before.inertia * before.angular + dt() * torque) / after.inertia;
      end.velocity += (angular - after.angular) * after.turning;
    }
  }

  double stored_energy(const VectorIn& d) const override {
    const Vectors y1 = y0_ + nodes_.to_nodes(d);
    double energy = 0;
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const polyfem::CorotatedElement& elastic = nodes_.shape().cells[c].elastic;
      energy += elastic.energy(nodes_.frame(y1, c), initial_forces_[c]) -
                elastic.energy(frames_[c], initial_forces_[c]);
    }
    return energy;
  }
  double elastic_loss(const VectorIn& d, const VectorIn& elastic) const override {
    return rule().mean_forces() ? 0 : BlockStep::elastic_loss(d, elastic);
  }

 private:
  static bool keeps_acceleration(const StepRule& rule) { return rule.history() != 0 || rule.gamma != 1; }

  /// Newmark's acceleration after the step.
  Vectors acceleration_after(const Vectors& step) const {
    Vectors after = rule().inertia() / (dt() * dt()) * (step - dt() * velocity_);
    if (rule().history() != 0) after -= rule().history() * acceleration_;
    return after;
  }

  const StepRule& rule() const { return matrices_->rule; }
  double dt() const { return matrices_->dt; }

  const Block& block_;
  const Nodes nodes_;
  std::shared_ptr<const StepMatrices> matrices_;
  Vectors y0_, velocity_, acceleration_;  ///< of the nodes at the start
  std::vector<Frame> frames_;             ///< of the cells at the start
  std::vector<Stacked> initial_forces_;   ///< of the stress that the reference shape has, of each cell
};

}  // namespace ddacontact
