#include <ddacontact/block/modal_motion.hpp>

#include <ddacontact/block/corotational_motion.hpp>

#include <cmath>
#include <vector>

namespace ddacontact {

namespace {

/// Numbers that live until the next call in the same thread.
Eigen::Map<VectorXd> scratch(Index n) {
  thread_local std::vector<double> numbers;
  if (numbers.size() < static_cast<std::size_t>(n)) numbers.resize(static_cast<std::size_t>(n));
  return {numbers.data(), n};
}

/// A quarter turn to the left of every vector.
template <class Vectors>
Vectors left(const Vectors& of) {
  Vectors turned(2, of.cols());
  turned.row(0) = -of.row(1);
  turned.row(1) = of.row(0);
  return turned;
}

/// Phi q of the nodes.
template <class Of>
typename Of::Vectors deformation(const ModalShape& modal, const ModalMotion::Numbers& q) {
  typename Of::Stacked u(2 * modal.nodes.cols());
  u.noalias() = modal.deformations * q;
  return u.reshaped(2, modal.nodes.cols());
}

}  // namespace

void ModalMotion::begin(const CorotationalShape& shape, const StepRule& rule, double dt,
                        const Numbers& coordinates, const Numbers& velocity, const Numbers& initial) {
  shape_ = &shape;
  dt_ = dt;
  impulse_time_ = rule.impulse_time * dt;
  start_ = coordinates;
  initial_ = initial;
  const ModalShape& modal = shape.modal();
  const Index n = modal.n_unknowns(), k = modal.n_deformations();
  const auto q = start_.tail(k);
  turn_ = turned_by(start_[2]);
  leverage_ = modal.leverage(q);
  for (VectorXd* numbers : {&before_, &inertia_, &mass_, &drive_}) numbers->resize(n);
  coupling_.resize(k);
  with_nodes(shape, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    const typename Of::Stacked around = left(deformation<Of>(modal, q)).reshaped();
    coupling_.noalias() = modal.momenta_of.transpose() * around;
    to_motions<Of>(nodes.to_nodes(velocity), before_);
  });

  inertia_.setOnes();
  inertia_.head<2>().setConstant(modal.mass);
  inertia_[2] = modal.inertia(q);
  const double h = impulse_time_;
  mass_ = (1 + h * rule.damping.mass) * inertia_;
  mass_.tail(k) += h * (dt + rule.damping.stiffness) * modal.stiffness;
  centrifugal_ = before_[2] * before_[2] * (modal.radial + q);
  drive_ = inertia_.cwiseProduct(before_);
  drive_.tail(k) += h * (centrifugal_ - modal.stiffness.cwiseProduct(q));
  if (initial_.size() > 0) drive_.tail(k) -= h * initial_;
}

template <class Of>
void ModalMotion::to_motions(const typename Of::Vectors& velocities, Written s) const {
  const ModalShape& modal = shape_->modal();
  const typename Of::Vectors in_frame = turn_.transpose() * velocities;
  const typename Of::Stacked rates = in_frame.reshaped();
  s.head<2>() = velocities.lazyProduct(modal.weights);
  s[2] = modal.turning.cwiseProduct(in_frame).sum() / leverage_;
  auto of_deformations = s.tail(modal.n_deformations());
  of_deformations.noalias() = modal.momenta_of.transpose() * rates;
  of_deformations -= s[2] * coupling_;
}

template <class Of>
typename Of::Vectors ModalMotion::to_nodes(const Numbers& forces) const {
  const ModalShape& modal = shape_->modal();
  const auto of_deformations = forces.tail(modal.n_deformations());
  const double torque = (forces[2] - coupling_.dot(of_deformations)) / leverage_;
  typename Of::Stacked f(2 * modal.nodes.cols());
  f.noalias() = modal.momenta_of * of_deformations;
  typename Of::Vectors on_nodes = f.reshaped(2, modal.nodes.cols());
  on_nodes += torque * modal.turning;
  on_nodes = (turn_ * on_nodes).eval();
  on_nodes += Vec2(forces.head<2>()).lazyProduct(modal.weights.transpose());
  return on_nodes;
}

template <class Of>
typename Of::Vectors ModalMotion::node_displacements(const Numbers& change) const {
  const ModalShape& modal = shape_->modal();
  const double half = std::sin(change[2] / 2);
  Mat2 turn;  // R(change) - 1 without cancellation
  turn << -2 * half * half, -std::sin(change[2]), std::sin(change[2]), -2 * half * half;
  typename Of::Vectors Z = deformation<Of>(modal, start_.tail(modal.n_deformations()));
  Z += modal.nodes;
  const typename Of::Vectors stretch = deformation<Of>(modal, change.tail(modal.n_deformations()));
  typename Of::Vectors moved = turn_ * turn * Z;
  moved += turn_ * turned_by(change[2]) * stretch;
  moved += Vec2(change.head<2>()).lazyProduct(modal.translation.transpose());
  return moved;
}

void ModalMotion::modal_velocity(const Numbers& d, Written s) const {
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) { to_motions<Of>(nodes.to_nodes(d), s); });
  s /= dt_;
}

VectorXd ModalMotion::modal_velocity(const Numbers& d) const {
  VectorXd s(start_.size());
  modal_velocity(d, s);
  return s;
}

void ModalMotion::forces(const Numbers& d, Written resisting) const {
  Eigen::Map<VectorXd> of_motions = scratch(start_.size());
  modal_velocity(d, of_motions);
  of_motions = (mass_.cwiseProduct(of_motions) - drive_) / impulse_time_;
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    nodes.forces_on_unknowns(to_nodes<Of>(of_motions), resisting);
  });
}

void ModalMotion::free_path(Written d) const {
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    const ModalShape& modal = shape_->modal();
    const Index k = modal.n_deformations();
    typename Of::Vectors Z = deformation<Of>(modal, start_.tail(k));
    Z += modal.nodes;
    typename Of::Vectors rates = before_[2] * left(Z) + deformation<Of>(modal, before_.tail(k));
    rates = (turn_ * rates).eval();
    rates += Vec2(before_.head<2>()).lazyProduct(modal.translation.transpose());
    nodes.to_unknowns(dt_ * rates, d);
  });
}

void ModalMotion::displacement(const Numbers& d, Written displaced) const {
  Eigen::Map<VectorXd> change = scratch(start_.size());
  modal_velocity(d, change);
  change *= dt_;
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    nodes.to_unknowns(node_displacements<Of>(change), displaced);
  });
}

double ModalMotion::stored_energy(const Numbers& d) const {
  const ModalShape& modal = shape_->modal();
  const Index k = modal.n_deformations();
  Eigen::Map<VectorXd> change = scratch(start_.size());
  modal_velocity(d, change);
  change *= dt_;
  const auto dq = change.tail(k);
  double stored = modal.stiffness.cwiseProduct(start_.tail(k) + dq / 2).dot(dq);
  if (initial_.size() > 0) stored += initial_.dot(dq);
  return stored;
}

void ModalMotion::end(const Numbers& d, const Numbers& external, Written coordinates, Eigen::Ref<Points> places,
                      Written velocity) const {
  const ModalShape& modal = shape_->modal();
  const Index k = modal.n_deformations();
  Eigen::Map<VectorXd> s = scratch(start_.size());
  modal_velocity(d, s);
  coordinates = start_ + dt_ * s;
  if (external.size() > 0) {
    with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
      typename Of::Vectors Z = deformation<Of>(modal, start_.tail(k));
      Z += modal.nodes;
      const typename Of::Vectors turning = turn_ * left(Z);
      const Vec3 forces(nodes.work(external, nodes.everywhere(Vec2::UnitX())),
                        nodes.work(external, nodes.everywhere(Vec2::UnitY())), nodes.work(external, turning));
      s.head<3>() = (drive_.head<3>() + impulse_time_ * forces).cwiseQuotient(mass_.head<3>());
    });
  }
  s[2] *= inertia_[2] / modal.inertia(coordinates.tail(k));
  const Mat2 turn = turned_by(coordinates[2]);
  Eigen::Map<VectorXd>(places.data(), places.size()).noalias() = modal.place_deformations * coordinates.tail(k);
  places += modal.places;
  for (Index p = 0; p < places.cols(); ++p) places.col(p) = turn * Vec2(places.col(p)) + coordinates.head<2>();
  with_nodes(*shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    typename Of::Vectors Z = deformation<Of>(modal, coordinates.tail(k));
    Z += modal.nodes;
    typename Of::Vectors rates = s[2] * left(Z) + deformation<Of>(modal, s.tail(k));
    rates = (turn * rates).eval();
    rates += Vec2(s.head<2>()).lazyProduct(modal.translation.transpose());
    nodes.to_unknowns(rates, velocity);
  });
}

}  // namespace ddacontact
