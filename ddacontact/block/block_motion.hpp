/// \file A block's step by its motions: with what forces it resists the motion of its unknowns.
///
/// Velocities (vc, omega, u') of the middle of a step follow from those of the middle of the step before by
/// impulses over the time h between the two, on the shape at the start:
///     (1 + alpha h) m vc = m vc_before + h f,        (1 + alpha h) I omega = I omega_before + h torque,
///     ((1 + alpha h) M + h (dt + beta) K) u' = M u'_before + h (omega_before^2 M (X + u) - K u - f0 + f),
/// with Rayleigh's alpha and beta: leapfrog for the motion as a rigid body, backward Euler for the
/// deformation. By central differences -h beta K u'_before on the right stands for h (dt + beta) K u' on the
/// left. Unknowns are displacements d = dt v of the straight motion that the velocities v of the shape at the
/// start make; where it leads to is `displacement`.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>

#include <span>

namespace ddacontact {

/// The step of a block that its motions carry on, on the shape at its start.
class BlockMotion final : public BlockStep {
 public:
  /// Keeps references.
  BlockMotion(const Block& block, const CorotationalShape& shape) : block_(block), shape_(shape) {}

  /// Begins a step.
  /// \param[in] coordinates  of the block, see BlockState::coordinates
  /// \param[in] velocity     of its unknowns in the middle of the step before
  /// \param[in] initial      forces of the stress at rest on the nodes, in the block's frame; empty: none
  void begin(const StepRule& rule, double dt, const VectorIn& coordinates, const VectorIn& velocity,
             const VectorIn& initial);

  const BlockMotion* motion() const override { return this; }
  void free_path(VectorOut d) const override;
  /// What resists is inertia: all external forces under which the motion is d.
  void forces(const VectorIn& d, BlockForces& forces) const override;
  /// Of the shape at rest: what deformation changes of it is of the order of the strain.
  void tangent(const VectorIn& d, std::span<MatrixXd> parts) const override;
  void displacement(const VectorIn& d, VectorOut displaced) const override;
  double stored_energy(const VectorIn& d) const override;
  /// The velocities are those in the middle of the step, on the shape at its end, which has the angular momentum
  /// of the step. A free block takes its momenta from `external`: what is left of these forces in d has the
  /// solution's error.
  void end(const VectorIn& d, const VectorIn& external, bool is_free, BlockState& next) const override;

  /// Energy taken by Rayleigh damping, and by the scheme from the work of elastic forces and of inertia
  /// before the change of kinetic energy is taken off, J per m.
  struct Losses {
    double damping = 0, scheme = 0;
  };
  Losses losses(const VectorIn& d) const;
  /// Mass and moment of inertia times the accelerations, N and N m per m.
  Vec3 resultant(const VectorIn& d) const;

 private:
  /// (vc, omega, u') of velocities of the nodes.
  template <class Of>
  struct Velocities {
    Vec2 linear;
    double angular;
    typename Of::Vectors deformation;
  };
  template <class Of>
  Velocities<Of> velocities(const typename Of::Vectors& of_nodes) const;
  template <class Of>
  typename Of::Vectors times_stiffness(const typename Of::Vectors& u) const;
  /// velocities, and work(nodes, velocities of d, in m and rad a step)
  template <class Work>
  auto with_motion(const VectorIn& d, const Work& work) const;

  /// Arrays of the nodes in the block's frame: X + u; u' before; the right side without f; f0, where there is
  /// any.
  enum Array : Index { shape_now, deforming, drive, stress_forces };
  template <class Of>
  auto array(Array k) const {
    const Index m = shape_.motions().n_nodes();
    return Eigen::Map<const typename Of::Vectors, Eigen::Aligned16>(arrays_[k * m].data(), 2, m);
  }
  template <class Of>
  typename Of::Vectors left_of_shape() const {
    return left(typename Of::Vectors(array<Of>(shape_now)));
  }

  bool is_explicit() const { return matrices_->rule.is_explicit(); }
  const RayleighDamping& damping() const { return matrices_->rule.damping; }
  double dt() const { return matrices_->dt; }
  double impulse_time() const { return matrices_->rule.impulse_time * dt(); }

  const Block& block_;
  const CorotationalShape& shape_;
  std::shared_ptr<const StepMatrices> matrices_;
  std::vector<Vec2> arrays_;
  Vec2 linear_before_;  ///< vc
  double angular_before_ = 0;
  double inertia_ = 0, leverage_ = 0;  ///< Z M Z and X M Z with Z = X + u
  Mat2 turn_;                          ///< R at the start
};

}  // namespace ddacontact
