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
  using Array = Eigen::Map<const Vectors, Eigen::Aligned16>;

  /// Keeps references.
  CorotationalStep(const Block& block, const CorotationalShape& shape) : block_(block), nodes_(shape) {}

  /// Begins a step.
  void begin(const StepRule& rule, double dt, const Vectors& y, const Vectors& velocity,
             const Vectors& acceleration, const TensorsRef& initial_stress) {
    start_.take_matrices(nodes_.shape(), rule, dt);
    at_ = StepPoints(nodes_.shape(), rule);
    const std::vector<ShapeCell>& cells = nodes_.shape().cells;
    const bool stressed = !initial_stress.isZero(0);
    start_.arrays.resize(static_cast<std::size_t>(stressed ? at_.end : at_.initial_forces));
    const auto put = [&](const Vectors& array, Index column) {
      Eigen::Map<Vectors, Eigen::Aligned16>(start_.arrays[column].data(), 2, array.cols()) = array;
    };
    put(y, 0);
    put(velocity, at_.velocity);
    if (keeps_acceleration(rule)) put(acceleration, at_.acceleration);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const Frame frame = nodes_.frame(y, c);
      const Index k = at_.cell(cells[c], c), n = cells[c].elastic.n_nodes();
      start_.arrays[k] = frame.rotation.col(0);
      start_.arrays[k + 1] = {frame.stretch, 0};
      put(frame.local, k + 2);
      if (!stressed) continue;
      polyfem::stress_forces(
          cells[c].element, initial_stress.middleCols(cells[c].first_point, cells[c].element.n_points()),
          Eigen::Map<VectorXd>(start_.arrays[at_.initial_forces + cells[c].first_node].data(), 2 * n));
    }
  }

  /// The nodes at the start.
  Array y0() const { return array(0, nodes_.n_nodes()); }

  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const override {
    const Vectors step = nodes_.to_nodes(d), y1 = y0() + step;
    Vectors elastic = Vectors::Zero(2, step.cols()), damping = elastic;
    if (rule().damping.mass != 0) damping = rule().damping.mass / dt() * nodes_.weighted(step);
    Stacked f, damped;
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const polyfem::CorotatedElement& element = nodes_.shape().cells[c].elastic;
      const Frame start = start_frame(c), to = nodes_.frame(y1, c), &from = rule().mean_forces() ? start : to;
      element.mean_force(from, to, 0, initial_force(c), f);
      nodes_.add_of_cell(f, c, elastic);
      if (rule().damping.stiffness == 0) continue;
      const Stacked rate = element.template times_stiffness<Of>(to.u - start.u);
      element.mean_force(from, to, 0, initial_force(c) + rule().damping.stiffness / dt() * rate, damped);
      nodes_.add_of_cell(damped - f, c, damping);
    }
    forces.resize(d.size());
    nodes_.forces_on_unknowns(elastic, forces.elastic);
    nodes_.forces_on_unknowns(nodes_.weighted(acceleration_after(step)), forces.inertia);
    nodes_.forces_on_unknowns(damping, forces.damping);
  }

  void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const override {
    const Vectors y1 = y0() + nodes_.to_nodes(d);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const ShapeCell& cell = nodes_.shape().cells[c];
      Mat2 rotation = nodes_.cell_rotation(y1, c);
      if (rule().directions() != Directions::of_end)
        rotation = polyfem::mid_rotation(turned_to(start_.arrays[at_.cell(cell, c)]), rotation);
      polyfem::rotate(start_.matrices->tangents[c], rotation, parts[c]);
      const MatrixXd& B = cell.nodes_by_unknowns;
      if (B.size() > 0) parts[c] = (B.transpose() * parts[c] * B).eval();
    }
  }

  void add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const override {
    const Vectors y = y0() + nodes_.to_nodes(d), way = nodes_.to_nodes(change);
    const typename Nodes::Rigid rigid = nodes_.rigid(y, way);
    const Vectors shift = nodes_.everywhere(rigid.linear),
                  strain = way - shift - rigid.angular * rigid.turning;
    const Mat2 turn = turned_by(rigid.angular) - Mat2::Identity();
    const Vectors moved = turn * (nodes_.arms(y) + strain) + strain + shift;
    Stacked of_unknowns(d.size());
    nodes_.to_unknowns(moved, of_unknowns);
    d += of_unknowns;
  }

  void free_path(Eigen::Ref<VectorXd> path) const override {
    const typename Nodes::Rigid motion = nodes_.rigid(y0(), velocity());
    const Mat2 turn = turned_by(2 * std::atan(dt() * motion.angular / 2));
    const Vectors r = nodes_.arms(y0());
    nodes_.to_unknowns(turn * r - r + nodes_.everywhere(dt() * motion.linear), path);
  }

  void end(const Eigen::Ref<const VectorXd>& d, const Eigen::Ref<const VectorXd>& external, bool is_free,
           BlockState& next) const override {
    const Vectors moved = nodes_.to_nodes(d);
    nodes_.put_points(y0() + moved, block_.points().columns_of(next.position));
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
    end.velocity = velocity();
    if (keeps_acceleration(rule())) end.velocity += dt() * (1 - rule().gamma) * acceleration();
    end.velocity += dt() * rule().gamma * end.acceleration;
    return end;
  }

  /// Gives a free block the momentum that forces of its unknowns have given it, instead of what is left of
  /// it after K d has cancelled; by forces at the middle its angular momentum as well.
  void keep_momenta(const Vectors& step, const Eigen::Ref<const VectorXd>& external, End& end) const {
    const auto work = [&](const Vectors& motion) {
      const double damped = rule().damping.mass == 0 ? 0
                                                     : rule().damping.mass / dt() *
                                                           nodes_.weighted(step).cwiseProduct(motion).sum();
      return nodes_.work(external, motion) - damped;
    };
    const Vec2 force(work(nodes_.everywhere(Vec2::UnitX())), work(nodes_.everywhere(Vec2::UnitY())));
    const Vec2 by_force = force / nodes_.shape().mass_total;
    const typename Nodes::Rigid before = nodes_.rigid(y0(), velocity()),
                                after = nodes_.rigid(y0() + step, end.velocity);
    Vec2 linear = before.linear + dt() * rule().gamma * by_force;
    if (keeps_acceleration(rule())) linear += dt() * (1 - rule().gamma) * nodes_.mean(acceleration());
    end.velocity += nodes_.everywhere(linear - after.linear);
    if (rule().history() != 0)
      end.acceleration += nodes_.everywhere(by_force - nodes_.mean(end.acceleration));
    if (rule().mean_forces()) {
      const double torque = work(nodes_.spin(y0() + step / 2));
      const double angular = (before.inertia * before.angular + dt() * torque) / after.inertia;
      end.velocity += (angular - after.angular) * after.turning;
    }
  }

  double stored_energy(const Eigen::Ref<const VectorXd>& d) const override {
    const Vectors y1 = y0() + nodes_.to_nodes(d);
    double energy = 0;
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const polyfem::CorotatedElement& elastic = nodes_.shape().cells[c].elastic;
      energy += elastic.energy(nodes_.frame(y1, c), initial_force(c)) -
                elastic.energy(start_frame(c), initial_force(c));
    }
    return energy;
  }
  double elastic_loss(const Eigen::Ref<const VectorXd>& d,
                      const Eigen::Ref<const VectorXd>& elastic) const override {
    return rule().mean_forces() ? 0 : BlockStep::elastic_loss(d, elastic);
  }

 private:
  static bool keeps_acceleration(const StepRule& rule) { return rule.history() != 0 || rule.gamma != 1; }

  /// Indices in CorotationalStart::arrays.
  struct StepPoints {
    StepPoints() = default;
    StepPoints(const CorotationalShape& shape, const StepRule& rule) {
      const Index m = shape.nodes.cols();
      velocity = m;
      acceleration = 2 * m;
      first_cell = acceleration + (keeps_acceleration(rule) ? m : 0);
      const ShapeCell& last = shape.cells.back();
      initial_forces = cell(last, shape.cells.size() - 1) + 2 + last.elastic.n_nodes();
      end = initial_forces + last.first_node + last.elastic.n_nodes();
    }
    Index cell(const ShapeCell& cell, std::size_t c) const {
      return first_cell + cell.first_node + 2 * static_cast<Index>(c);
    }
    Index velocity = 0, acceleration = 0, first_cell = 0, initial_forces = 0, end = 0;
  };

  Array array(Index column, Index n) const { return {start_.arrays[column].data(), 2, n}; }
  Array velocity() const { return array(at_.velocity, nodes_.n_nodes()); }
  Array acceleration() const { return array(at_.acceleration, nodes_.n_nodes()); }
  Frame start_frame(std::size_t c) const {
    const ShapeCell& cell = nodes_.shape().cells[c];
    const Index k = at_.cell(cell, c);
    Frame frame;
    frame.stretch = start_.arrays[k + 1].x();
    frame.rotation = turned_to(start_.arrays[k]);
    frame.local = array(k + 2, cell.elastic.n_nodes());
    cell.elastic.complete(frame);
    return frame;
  }
  Stacked initial_force(std::size_t c) const {
    const ShapeCell& cell = nodes_.shape().cells[c];
    if (static_cast<Index>(start_.arrays.size()) == at_.initial_forces)
      return Stacked::Zero(2 * cell.elastic.n_nodes());
    return array(at_.initial_forces + cell.first_node, cell.elastic.n_nodes()).reshaped();
  }

  /// Newmark's acceleration after the step.
  Vectors acceleration_after(const Vectors& step) const {
    Vectors after = rule().inertia() / (dt() * dt()) * (step - dt() * velocity());
    if (rule().history() != 0) after -= rule().history() * acceleration();
    return after;
  }

  const StepRule& rule() const { return start_.matrices->rule; }
  double dt() const { return start_.matrices->dt; }

  const Block& block_;
  const Nodes nodes_;
  CorotationalStart start_;
  StepPoints at_;
};

}  // namespace ddacontact
