/// \file A block's step by its motions: with what forces it resists the motion of its unknowns.
///
/// Velocities s = (vc, omega, q') of the middle of a step follow from those of the middle of the step before by
/// impulses over the time h between the two, on the shape at the start:
///     A s = M s_before + h (centrifugal - w^2 q - f0 + external),      A = (1 + alpha h) M + h (dt + beta) K,
/// with M = diag(m, m, I, 1), K = diag(0, 0, 0, w^2) and Rayleigh's alpha and beta: leapfrog for the motion as a
/// rigid body, backward Euler for the deformations. Unknowns are displacements d = dt v of the straight motion that the
/// velocities v of the shape at the start make; where it leads to is `displacement`.
#pragma once

#include <ddacontact/block/corotational_shape.hpp>
#include <ddacontact/block/step_start.hpp>

namespace ddacontact {

/// A step that was begun. Once it has been of a shape, others of it need no memory.
class ModalMotion {
 public:
  using Numbers = Eigen::Ref<const VectorXd>;
  using Written = Eigen::Ref<VectorXd>;

  /// \param[in] coordinates  of the block, see BlockState::modal
  /// \param[in] velocity     of its unknowns in the middle of the step before
  /// \param[in] initial      forces of the stress at rest on the deformations; empty: none
  void begin(const CorotationalShape& shape, const StepRule& rule, double dt, const Numbers& coordinates,
             const Numbers& velocity, const Numbers& initial);

  /// (A s - M s_before) / h - internal forces, of the unknowns: what external forces have to be.
  void forces(const Numbers& d, Written resisting) const;
  /// The straight motion without any forces.
  void free_path(Written d) const;
  /// s of a straight motion.
  void modal_velocity(const Numbers& d, Written s) const;
  VectorXd modal_velocity(const Numbers& d) const;
  /// Where it leads the unknowns to.
  void displacement(const Numbers& d, Written displaced) const;
  /// What it stores in the block, J per m.
  double stored_energy(const Numbers& d) const;

  /// Writes the block after the step: its coordinates and places, and the velocities of its unknowns on that
  /// shape in the middle of the step; the angular momentum is that of the step.
  /// \param[in] external  all forces on the unknowns of a free block, which takes its momenta from them: what is left
  ///                      of them in d has the solution's error; empty: it has supports
  void end(const Numbers& d, const Numbers& external, Written coordinates, Eigen::Ref<Points> places,
           Written velocity) const;

  /// R at the start.
  const Mat2& turn() const { return turn_; }
  const VectorXd& before() const { return before_; }
  /// The diagonal of M, and the centrifugal forces of the deformations.
  const VectorXd& inertia() const { return inertia_; }
  const VectorXd& centrifugal() const { return centrifugal_; }
  const ModalShape& modal() const { return shape_->modal(); }

 private:
  /// s of velocities of the nodes; the forces on the nodes that these on the motions are; and the displacements of
  /// the nodes by a change of the coordinates.
  template <class Of>
  void to_motions(const typename Of::Vectors& velocities, Written s) const;
  template <class Of>
  typename Of::Vectors to_nodes(const Numbers& forces) const;
  template <class Of>
  typename Of::Vectors node_displacements(const Numbers& change) const;

  const CorotationalShape* shape_ = nullptr;
  double dt_ = 0, impulse_time_ = 0;
  VectorXd start_, before_, inertia_, mass_, drive_, centrifugal_;
  VectorXd initial_;     ///< f0; empty: none
  double leverage_ = 0;  ///< X M Z, Z the shape at the start
  VectorXd coupling_;    ///< Phi' M J Z
  Mat2 turn_ = Mat2::Identity();
};

}  // namespace ddacontact
