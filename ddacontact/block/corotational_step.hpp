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
class CorotationalStep {
 public:
  using Nodes = NodalKinematics<Of>;
  using Vectors = typename Of::Vectors;
  using Stacked = typename Of::Stacked;
  using Frame = polyfem::CorotatedFrameOf<Of>;
  using Array = Eigen::Map<const Vectors, Eigen::Aligned16>;

  CorotationalStep(const Nodes& nodes, const CorotationalStart& start)
      : nodes_(nodes),
        start_(start),
        rule_(start.matrices->rule),
        dt_(start.matrices->dt),
        at_(nodes.shape(), rule_) {}

  /// Writes `start`, whose matrices are there.
  static void begin(const Nodes& nodes, const Vectors& y, const Vectors& velocity,
                    const Vectors& acceleration, const TensorsRef& initial_stress, CorotationalStart& start) {
    const StepRule& rule = start.matrices->rule;
    const std::vector<ShapeCell>& cells = nodes.shape().cells;
    const StepPoints at(nodes.shape(), rule);
    const bool stressed = !initial_stress.isZero(0);
    start.arrays.resize(static_cast<std::size_t>(stressed ? at.end : at.initial_forces));
    const auto put = [&](const Vectors& array, Index column) {
      Eigen::Map<Vectors, Eigen::Aligned16>(start.arrays[column].data(), 2, array.cols()) = array;
    };
    put(y, 0);
    put(velocity, at.velocity);
    if (keeps_acceleration(rule)) put(acceleration, at.acceleration);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const Frame frame = nodes.frame(y, c);
      const Index k = at.cell(cells[c], c), n = cells[c].elastic.n_nodes();
      start.arrays[k] = frame.rotation.col(0);
      start.arrays[k + 1] = {frame.stretch, 0};
      put(frame.local, k + 2);
      if (!stressed) continue;
      polyfem::stress_forces(
          cells[c].element, initial_stress.middleCols(cells[c].first_point, cells[c].element.n_points()),
          Eigen::Map<VectorXd>(start.arrays[at.initial_forces + cells[c].first_node].data(), 2 * n));
    }
  }

  /// The nodes at the start.
  Array y0() const { return array(0, nodes_.n_nodes()); }

  void forces(const Eigen::Ref<const VectorXd>& d, BlockForces& forces) const {
    const Vectors step = nodes_.to_nodes(d), y1 = y0() + step;
    Vectors elastic = Vectors::Zero(2, step.cols()), damping = elastic;
    if (rule_.damping.mass != 0) damping = rule_.damping.mass / dt_ * nodes_.weighted(step);
    Stacked f, damped;
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const polyfem::CorotatedElement& element = nodes_.shape().cells[c].elastic;
      const Frame start = start_frame(c), to = nodes_.frame(y1, c), &from = rule_.mean_forces() ? start : to;
      element.mean_force(from, to, 0, initial_force(c), f);
      nodes_.add_of_cell(f, c, elastic);
      if (rule_.damping.stiffness == 0) continue;
      const Stacked rate = element.template times_stiffness<Of>(to.u - start.u);
      element.mean_force(from, to, 0, initial_force(c) + rule_.damping.stiffness / dt_ * rate, damped);
      nodes_.add_of_cell(damped - f, c, damping);
    }
    forces.resize(d.size());
    nodes_.forces_on_unknowns(elastic, forces.elastic);
    nodes_.forces_on_unknowns(nodes_.weighted(acceleration_after(step)), forces.inertia);
    nodes_.forces_on_unknowns(damping, forces.damping);
  }

  void tangent(const Eigen::Ref<const VectorXd>& d, std::span<MatrixXd> parts) const {
    const Vectors y1 = y0() + nodes_.to_nodes(d);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      const ShapeCell& cell = nodes_.shape().cells[c];
      Mat2 rotation = nodes_.cell_rotation(y1, c);
      if (rule_.directions() != Directions::of_end)
        rotation = polyfem::mid_rotation(turned_to(start_.arrays[at_.cell(cell, c)]), rotation);
      polyfem::rotate(start_.matrices->tangents[c], rotation, parts[c]);
      const MatrixXd& B = cell.nodes_by_unknowns;
      if (B.size() > 0) parts[c] = (B.transpose() * parts[c] * B).eval();
    }
  }

  void add_change(const Eigen::Ref<const VectorXd>& change, Eigen::Ref<VectorXd> d) const {
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

  /// The displacements of the nodes without forces.
  Vectors free_path() const {
    const typename Nodes::Rigid motion = nodes_.rigid(y0(), velocity());
    const Mat2 turn = turned_by(2 * std::atan(dt_ * motion.angular / 2));
    const Vectors r = nodes_.arms(y0());
    return turn * r - r + nodes_.everywhere(dt_ * motion.linear);
  }

  /// Velocity and acceleration of the nodes after the step.
  struct End {
    Vectors velocity, acceleration;
  };
  End end(const Vectors& step) const {
    End end;
    end.acceleration = acceleration_after(step);
    end.velocity = velocity();
    if (keeps_acceleration(rule_)) end.velocity += dt_ * (1 - rule_.gamma) * acceleration();
    end.velocity += dt_ * rule_.gamma * end.acceleration;
    return end;
  }

  /// Gives a free block the momentum that forces of its unknowns have given it, instead of what is left of
  /// it after K d has cancelled; by forces at the middle its angular momentum as well.
  void keep_momenta(const Vectors& step, const Eigen::Ref<const VectorXd>& external, End& end) const {
    const auto work = [&](const Vectors& motion) {
      const double damped = rule_.damping.mass == 0
                                ? 0
                                : rule_.damping.mass / dt_ * nodes_.weighted(step).cwiseProduct(motion).sum();
      return nodes_.work(external, motion) - damped;
    };
    const Vec2 force(work(nodes_.everywhere(Vec2::UnitX())), work(nodes_.everywhere(Vec2::UnitY())));
    const Vec2 by_force = force / nodes_.shape().mass_total;
    const typename Nodes::Rigid before = nodes_.rigid(y0(), velocity()),
                                after = nodes_.rigid(y0() + step, end.velocity);
    Vec2 linear = before.linear + dt_ * rule_.gamma * by_force;
    if (keeps_acceleration(rule_)) linear += dt_ * (1 - rule_.gamma) * nodes_.mean(acceleration());
    end.velocity += nodes_.everywhere(linear - after.linear);
    if (rule_.history() != 0) end.acceleration += nodes_.everywhere(by_force - nodes_.mean(end.acceleration));
    if (rule_.mean_forces()) {
      const double torque = work(nodes_.spin(y0() + step / 2));
      const double angular = (before.inertia * before.angular + dt_ * torque) / after.inertia;
      end.velocity += (angular - after.angular) * after.turning;
    }
  }

  double stored_energy(const Vectors& step) const {
    const Vectors y1 = y0() + step;
    double energy = 0;
    for (std::size_t c = 0; c < nodes_.shape().cells.size(); ++c) {
      const polyfem::CorotatedElement& elastic = nodes_.shape().cells[c].elastic;
      energy += elastic.energy(nodes_.frame(y1, c), initial_force(c)) -
                elastic.energy(start_frame(c), initial_force(c));
    }
    return energy;
  }

 private:
  static bool keeps_acceleration(const StepRule& rule) { return rule.history() != 0 || rule.gamma != 1; }

  /// Indices in CorotationalStart::arrays.
  struct StepPoints {
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
    Index velocity, acceleration, first_cell, initial_forces, end;
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
    Vectors after = rule_.inertia() / (dt_ * dt_) * (step - dt_ * velocity());
    if (rule_.history() != 0) after -= rule_.history() * acceleration();
    return after;
  }

  const Nodes& nodes_;
  const CorotationalStart& start_;
  const StepRule& rule_;
  const double dt_;
  const StepPoints at_;
};

}  // namespace ddacontact
