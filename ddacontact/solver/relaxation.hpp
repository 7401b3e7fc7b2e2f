/// \file Contact forces relaxed one contact after the other: finds which contacts bear and which slide where
/// what happens within a step stays near where it happens.
#pragma once

#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/solver/block_inverse.hpp>

#include <array>
#include <vector>

namespace ddacontact {

/// The law of one contact as relaxation sees it, beside its term.
struct RelaxedLaw {
  const JointLaw* joint = nullptr;
  double shear = 0;      ///< the shear multiplier as the step began
  bool sliding = false;  ///< it is at the bound, whatever that is
};

/// Nonsmooth Gauss-Seidel iteration in the forces of the contacts (Moreau, Jean): the displacements always
/// balance the forces, d = A^-1 (Q + sum of G_c^T f_c), and each contact in turn is given the forces that its
/// law demands while the others stay. The matrix of each block is inverted by itself, so that a sweep costs
/// each contact its two blocks.
class ContactRelaxation {
 public:
  /// Takes the matrices of a problem. False: it does not serve them (blocks of several matrices, large ones).
  [[nodiscard]] bool set_matrices(FrictionProblem& problem);
  /// Moves d, where the contacts exert these forces and leave this residual, and the forces, until hardly a
  /// contact changes its state any more. Returns the number of sweeps.
  int relax(const std::vector<ContactTerm>& terms, const std::vector<RelaxedLaw>& laws,
            const VectorXd& residual, VectorXd& d, std::vector<ContactForce>& forces);

 private:
  /// How a contact's forces move one of its blocks: columns of A^-1 G^T, of the gap and of the slip.
  struct Answer {
    int block = -1;  ///< -1: none, or held
    std::array<double, BlockInverse::largest_block> of_normal, of_shear;
  };
  struct Local {
    double normal = 0, mixed = 0, shear = 0;  ///< G A^-1 G^T
    Answer answers[2];
  };

  void set_contact(const ContactTerm& term, Local& local) const;
  void move(const Answer& answer, double normal, double shear, VectorXd& d) const;

  const FrictionProblem* problem_ = nullptr;
  BlockInverse inverse_;
  std::vector<Local> locals_;
};

}  // namespace ddacontact
