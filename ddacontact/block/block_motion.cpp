#include <ddacontact/block/block_motion.hpp>

#include <ddacontact/block/corotational_motion.hpp>
#include <polyfem/element/matrices.hpp>

#include <cassert>

namespace ddacontact {

template <class Of>
BlockMotion::Velocities<Of> BlockMotion::velocities(const typename Of::Vectors& of_nodes) const {
  const MotionShape& shape = shape_.motions();
  Velocities<Of> found;
  found.linear = of_nodes.lazyProduct(shape.weights);
  const typename Of::Vectors apart = of_nodes - found.linear.lazyProduct(shape.translation.transpose());
  found.deformation = turn_.transpose() * apart;
  found.angular = shape.turning.cwiseProduct(found.deformation).sum() / leverage_;
  found.deformation -= found.angular * left_of_shape<Of>();
  return found;
}

template <class Of>
typename Of::Vectors BlockMotion::times_stiffness(const typename Of::Vectors& u) const {
  const Index n = u.cols();
  if (shape_.is_one_cell())
    return shape_.cells[0]
        .elastic.template times_stiffness<Of>(typename Of::Stacked(u.reshaped()))
        .reshaped(2, n);
  const VectorXd f = shape_.motions().stiffness * Eigen::Map<const VectorXd>(u.data(), 2 * n);
  return f.reshaped(2, n);
}

template <class Work>
auto BlockMotion::with_motion(const VectorIn& d, const Work& work) const {
  return with_nodes(shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    return work(nodes, velocities<Of>(nodes.to_nodes(d)));
  });
}

void BlockMotion::begin(const StepRule& rule, double dt, const VectorIn& coordinates,
                        const VectorIn& velocity, const VectorIn& initial) {
  if (!matrices_ || !matrices_->are_for(rule, dt)) matrices_ = step_matrices(shape_, rule, dt);
  const MotionShape& motions = shape_.motions();
  const Index m = motions.n_nodes();
  assert(coordinates.size() == BlockState::n_rigid + 2 * m && coordinates.allFinite());
  arrays_.resize(static_cast<std::size_t>((initial.size() > 0 ? stress_forces + 1 : stress_forces) * m));
  with_nodes(shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    using Vectors = typename Of::Vectors;
    const auto put = [&](Array k, const Vectors& of_nodes) {
      Eigen::Map<Vectors, Eigen::Aligned16>(arrays_[k * m].data(), 2, m) = of_nodes;
    };
    const Vectors u = coordinates.tail(2 * m).reshaped(2, m), Z = motions.nodes + u,
                  of_shape = nodes.weighted(Z);
    put(shape_now, Z);
    inertia_ = of_shape.cwiseProduct(Z).sum();
    leverage_ = motions.weighted.cwiseProduct(Z).sum();
    turn_ = turned_by(coordinates[2]);
    const auto [linear, angular, rates] = velocities<Of>(nodes.to_nodes(velocity));
    linear_before_ = linear;
    angular_before_ = angular;
    put(deforming, rates);
    Vectors force = angular * angular * of_shape - times_stiffness<Of>(u);
    if (initial.size() > 0) {
      put(stress_forces, initial.reshaped(2, m));
      force -= initial.reshaped(2, m);
    }
    if (is_explicit() && damping().stiffness != 0) force -= damping().stiffness * times_stiffness<Of>(rates);
    put(drive, nodes.weighted(rates) + impulse_time() * force);
  });
}

void BlockMotion::forces(const VectorIn& d, BlockForces& forces) const {
  forces.resize(d.size());
  forces.elastic().setZero();
  forces.damping().setZero();
  with_motion(d, [&]<class Of>(const NodalKinematics<Of>& nodes, const Velocities<Of>& way) {
    using Vectors = typename Of::Vectors;
    const MotionShape& motions = shape_.motions();
    const double h = impulse_time(), damped = 1 + h * damping().mass;
    Vectors f = damped / dt() * nodes.weighted(way.deformation);
    if (!is_explicit()) f += h * (1 + damping().stiffness / dt()) * times_stiffness<Of>(way.deformation);
    f -= array<Of>(drive);
    f /= h;
    const Vec2 linear = motions.mass / h * (damped / dt() * way.linear - linear_before_),
               of_deformation = f.lazyProduct(motions.translation);
    const double torque = inertia_ / h * (damped / dt() * way.angular - angular_before_),
                 moment = left_of_shape<Of>().cwiseProduct(f).sum();
    // Forces on the deformation of a motion, what is rigid in it taken off.
    f += (torque - moment) / leverage_ * motions.turning;
    f -= of_deformation.lazyProduct(motions.weights.transpose());
    f = (turn_ * f).eval();
    f += linear.lazyProduct(motions.weights.transpose());
    nodes.forces_on_unknowns(f, forces.inertia());
  });
}

void BlockMotion::tangent(const VectorIn&, std::span<MatrixXd> parts) const {
  for (std::size_t c = 0; c < parts.size(); ++c) {
    polyfem::rotate(matrices_->tangents[c], turn_, parts[c]);
    const MatrixXd& B = shape_.cells[c].nodes_by_unknowns;
    if (B.size() > 0) parts[c] = (B.transpose() * parts[c] * B).eval();
  }
}

void BlockMotion::free_path(VectorOut d) const {
  with_nodes(shape_, [&]<class Of>(const NodalKinematics<Of>& nodes) {
    using Vectors = typename Of::Vectors;
    const Vectors rates = angular_before_ * left_of_shape<Of>() + array<Of>(deforming);
    nodes.to_unknowns(dt() * (turn_ * rates + nodes.everywhere(linear_before_)), d);
  });
}

void BlockMotion::displacement(const VectorIn& d, VectorOut displaced) const {
  with_motion(d, [&]<class Of>(const NodalKinematics<Of>& nodes, const Velocities<Of>& way) {
    using Vectors = typename Of::Vectors;
    Vectors moved =
        turn_less_one(way.angular) * array<Of>(shape_now) + turned_by(way.angular) * way.deformation;
    moved = (turn_ * moved).eval();
    moved += nodes.everywhere(way.linear);
    nodes.to_unknowns(moved, displaced);
  });
}

double BlockMotion::stored_energy(const VectorIn& d) const {
  return with_motion(d, [&]<class Of>(const NodalKinematics<Of>&, const Velocities<Of>& way) {
    using Vectors = typename Of::Vectors;
    const Vectors middle = array<Of>(shape_now) - shape_.motions().nodes + way.deformation / 2;
    double stored = times_stiffness<Of>(middle).cwiseProduct(way.deformation).sum();
    if (std::ssize(arrays_) > stress_forces * shape_.motions().n_nodes())
      stored += array<Of>(stress_forces).cwiseProduct(way.deformation).sum();
    return stored;
  });
}

BlockMotion::Losses BlockMotion::losses(const VectorIn& d) const {
  return with_motion(d, [&]<class Of>(const NodalKinematics<Of>& nodes, const Velocities<Of>& way) {
    using Vectors = typename Of::Vectors;
    const double mass = shape_.motions().mass;
    const Vectors elastic = times_stiffness<Of>(way.deformation);
    const double stretched = elastic.cwiseProduct(way.deformation).sum();
    const Vectors momentum = nodes.weighted(way.deformation);
    const double quadratic = mass * way.linear.squaredNorm() + inertia_ * way.angular * way.angular +
                             momentum.cwiseProduct(way.deformation).sum();
    const double with_before = mass * way.linear.dot(linear_before_) +
                               inertia_ * way.angular * angular_before_ +
                               momentum.cwiseProduct(array<Of>(deforming)).sum();
    Losses losses;
    const double damped = is_explicit() ? elastic.cwiseProduct(array<Of>(deforming)).sum() : stretched / dt();
    // An impulse takes itself times the mean of the velocities before and after.
    const double by_mass = damping().mass * impulse_time() / dt() * (with_before + quadratic / dt()) / 2;
    losses.damping = by_mass + damping().stiffness * damped;
    // Backward Euler takes K (d u)^2 / 2 of what a change of the deformation stores; forces of the start give
    // as much.
    losses.scheme = (is_explicit() ? -stretched : stretched) / 2 + damping().mass / dt() * quadratic -
                    by_mass + (quadratic / dt() - with_before) / impulse_time() -
                    angular_before_ * angular_before_ * momentum.cwiseProduct(array<Of>(shape_now)).sum();
    return losses;
  });
}

Vec3 BlockMotion::resultant(const VectorIn& d) const {
  return with_motion(d, [&]<class Of>(const NodalKinematics<Of>&, const Velocities<Of>& way) {
    const Vec2 force = shape_.motions().mass / impulse_time() * (way.linear / dt() - linear_before_);
    return Vec3(force.x(), force.y(), inertia_ / impulse_time() * (way.angular / dt() - angular_before_));
  });
}

void BlockMotion::end(const VectorIn& d, const VectorIn& external, bool is_free, BlockState& next) const {
  auto coordinates = block_.coordinates().of(next.coordinates);
  with_motion(d, [&]<class Of>(const NodalKinematics<Of>& nodes, Velocities<Of> way) {
    using Vectors = typename Of::Vectors;
    const MotionShape& motions = shape_.motions();
    const Index m = motions.n_nodes();
    coordinates.head<2>() += way.linear;
    coordinates[2] += way.angular;
    // Round-off that is rigid in the deformation would add up, and turn with the block.
    Vectors u = coordinates.tail(2 * m).reshaped(2, m) + way.deformation;
    u -= nodes.everywhere(u.lazyProduct(motions.weights));
    u -= motions.turning.cwiseProduct(u).sum() / motions.rest_inertia * left(Vectors(motions.nodes));
    coordinates.tail(2 * m) = u.reshaped();
    const Vectors Z = motions.nodes + u;
    const Mat2 turn = turned_by(coordinates[2]);
    Vectors y = turn * Z;
    y += nodes.everywhere(coordinates.head<2>());
    nodes.put_points(y, block_.points().columns_of(next.position));

    Vec2 linear = way.linear / dt();
    double angular = way.angular / dt();
    if (is_free) {
      const double h = impulse_time(), damped = 1 + h * damping().mass;
      const Vectors turning = turn_ * left_of_shape<Of>();
      const Vec2 force(nodes.work(external, nodes.everywhere(Vec2::UnitX())),
                       nodes.work(external, nodes.everywhere(Vec2::UnitY())));
      linear = (linear_before_ + h / motions.mass * force) / damped;
      angular = (angular_before_ + h / inertia_ * nodes.work(external, turning)) / damped;
    }
    angular *= inertia_ / nodes.weighted(Z).cwiseProduct(Z).sum();
    const Vectors rates = angular * left(Z) + way.deformation / dt();
    Vectors v = turn * rates;
    v += nodes.everywhere(linear);
    // The weights sum to one but for round-off, which would add up from step to step.
    v += nodes.everywhere(linear - v.lazyProduct(motions.weights));
    nodes.to_unknowns(v, block_.unknowns().of(next.carried));
  });
  block_.follow_with_origin(next);
}

}  // namespace ddacontact
