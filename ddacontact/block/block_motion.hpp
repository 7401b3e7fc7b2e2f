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

namespace ddacontact {

/// A step that was begun: a view of what CorotationalStart keeps of its start.
class BlockMotion {
 public:
  using VectorIn = Eigen::Ref<const VectorXd>;
  using VectorOut = Eigen::Ref<VectorXd>;

  /// Writes `start`, whose matrices are there.
  /// \param[in] coordinates  of the block, see BlockState::coordinates
  /// \param[in] velocity     of its unknowns in the middle of the step before
  /// \param[in] initial      forces of the stress at rest on the nodes, in the block's frame; empty: none
  static void begin(const CorotationalShape& shape, const VectorIn& coordinates, const VectorIn& velocity,
                    const VectorIn& initial, CorotationalStart& start);
  BlockMotion(const CorotationalShape& shape, const CorotationalStart& start);

  /// External forces on the unknowns under which the motion is d, N per m.
  void forces(const VectorIn& d, VectorOut resisting) const;
  /// The straight motion without any forces.
  void free_path(VectorOut d) const;
  /// Displacements of the unknowns after a straight motion.
  void displacement(const VectorIn& d, VectorOut displaced) const;
  /// Energy that a straight motion stores in the block, J per m.
  double stored_energy(const VectorIn& d) const;
  /// Energy taken by Rayleigh damping, and by the scheme from the work of elastic forces and of inertia
  /// before the change of kinetic energy is taken off, J per m.
  struct Losses {
    double damping = 0, scheme = 0;
  };
  Losses losses(const VectorIn& d) const;
  /// Mass and moment of inertia times the accelerations, N and N m per m.
  Vec3 resultant(const VectorIn& d) const;

  /// Writes the block after the step: its coordinates (those at the start are given) and points, and the
  /// velocities of its unknowns on that shape in the middle of the step; the angular momentum is that of the
  /// step.
  /// \param[in] external  all forces on the unknowns of a free block, which takes its momenta from them: what
  ///                      is left of them in d has the solution's error; empty: it has supports
  void end(const VectorIn& d, const VectorIn& external, VectorOut coordinates, Eigen::Ref<Points> points,
           VectorOut velocity) const;

  /// R at the start.
  const Mat2& turn() const { return turn_; }

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

  /// Entries of the start, two numbers each: vc before; (omega before, 0); (Z M Z, X M Z) with Z = X + u; the
  /// first column of R.
  enum Number : Index { velocity_before, spin_before, about_centre, axis_now, n_numbers };
  /// Arrays of the nodes in the block's frame that follow those entries: X + u; u' before; the right side
  /// without f; f0, where there is any.
  enum Array : Index { shape_now, deforming, drive, stress_forces };
  template <class Of>
  auto array(Array k) const {
    const Index m = shape_.motions().n_nodes();
    return Eigen::Map<const typename Of::Vectors, Eigen::Aligned16>(start_.arrays[n_numbers + k * m].data(),
                                                                    2, m);
  }
  template <class Of>
  typename Of::Vectors left_of_shape() const {
    return left(typename Of::Vectors(array<Of>(shape_now)));
  }

  const CorotationalShape& shape_;
  const CorotationalStart& start_;
  RayleighDamping damping_;
  bool is_explicit_;
  double dt_, impulse_time_;
  Vec2 linear_before_;
  double angular_before_;
  double inertia_, leverage_;  ///< Z M Z and X M Z with Z = X + u
  Mat2 turn_;
};

}  // namespace ddacontact
