/// \file The contact problem of a step as solvers see it: unknowns, what is left over of forces, and what moves it.
#pragma once

#include <ddacontact/contact/contact.hpp>
#include <ddacontact/solver/friction_problem.hpp>

#include <optional>
#include <vector>

namespace ddacontact {

/// Residual of the balance of forces: r = internal and inertial forces - external and contact forces.
struct Residual {
  VectorXd force;             ///< r of every unknown; at a prescribed one it is the reaction
  VectorXd external;          ///< on every unknown: loads, gravity, contacts, springs at fixed points
  double largest = 0;         ///< over the free unknowns, forces (moments over the block's size), N per m
  double scale = 0;           ///< the largest sum over a block of the magnitudes of the forces on it, N per m
  double round_off = 0;       ///< bound of the round-off in r, N per m
  double block_relative = 0;  ///< the largest part of the forces on a block that is left: its sum over the
                              ///< free unknowns, less the round-off bound of each, over the force sum
  int worst_block = -1;       ///< that `block_relative` is of; -1: all are below their bounds
  double over_round_off = 0;  ///< the largest over the free unknowns over the round-off bound of its block

  bool balanced(double tolerance) const { return largest <= tolerance * scale + round_off; }
};

/// Whether the step may be accepted; if it is not settled, it is cut.
enum class SolutionStatus {
  settled,             ///< the residual passes, states agree, penetration is below its tolerance
  friction_unsettled,  ///< open and closed agree; stick and slip, or the size of friction, do not
  states_unsettled,    ///< some contact is open that should be closed, or closed that should be open
  forces_unsettled,    ///< the residual does not pass
  penetrating,         ///< the residual passes, penetration stays above its tolerance
  not_positive_definite,
  not_finite
};

/// Balance of forces as a function of displacements d of all unknowns within the step. Blocks are numbers: those
/// of the pairs of the contacts.
class StepProblem {
 public:
  virtual ~StepProblem() = default;

  /// Whether contact forces of the start of the step move it, whose gaps are left as they are.
  virtual bool is_explicit() const = 0;
  /// The step's displacements of prescribed unknowns, zero elsewhere.
  virtual const VectorXd& prescribed() const = 0;
  /// By which each unknown is multiplied for a length, m over its unit.
  virtual const VectorXd& unknown_lengths() const = 0;

  /// Residual of displacements d when the contacts exert these forces.
  /// \param[in] terms  of the contacts: their gradients are what forces act along
  virtual void compute_residual(const VectorXd& d, const std::vector<Contact>& contacts,
                                const std::vector<ContactTerm>& terms,
                                const std::vector<ContactForce>& forces, Residual& residual) const = 0;
  /// The sum of the magnitudes of the forces on a block when the residual was computed last, N per m;
  /// infinity where it does not change.
  virtual double sum_of_forces(int block) const = 0;
  /// The stiffness with which the blocks of a contact, each held at its other vertices, resist that it closes,
  /// with the inertia of the step, N/m per m: the lower of both; infinity where both vertices are held.
  virtual double contact_stiffness(const Contact& contact) const = 0;

  /// Where d leads the unknowns to, rotations carried out; d is changed so that prescribed ones are where they
  /// should be.
  virtual VectorXd displacement(VectorXd& d) const = 0;
  /// d += change, the rotations of free blocks carried out as such; less of it when a block would move further
  /// than a part of its size: what is linear holds for small changes.
  virtual void move(const VectorXd& change, VectorXd& d) const = 0;
  /// How far the last part of the way to d, `change`, leads points of each block off the straight line, m: by no
  /// more than its way over its size. Nothing where held points would not stay where they are.
  virtual std::optional<std::vector<double>> bends(const VectorXd& d, const VectorXd& change) const = 0;

  /// Makes the matrix that of d.
  virtual void linearize(const VectorXd& d) = 0;
  /// The matrix, its factor and what is solved with it.
  virtual FrictionProblem& problem() = 0;
};

}  // namespace ddacontact
