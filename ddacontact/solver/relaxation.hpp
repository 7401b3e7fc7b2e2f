/// \file Contact forces relaxed one contact after the other: finds which contacts bear and which slide where
/// what happens within a step stays near where it happens.
#pragma once

#include <ddacontact/contact/joint_law.hpp>
#include <ddacontact/solver/contact_side.hpp>

#include <array>
#include <vector>

namespace ddacontact {

/// The law of one contact as relaxation sees it, beside its term.
struct RelaxedLaw {
  const JointLaw* joint = nullptr;
  double shear = 0;      ///< the shear multiplier as the step began
  bool sliding = false;  ///< it is at the bound, whatever that is
  bool bonded = false;
};

/// Nonsmooth Gauss-Seidel iteration in the forces of the contacts (Moreau, Jean): the displacements always
/// balance the forces, d = A^-1 (Q + sum of G_c^T f_c), and each contact in turn is given the forces that its
/// law demands while the others stay. The matrix of each block is inverted by itself, so that a sweep costs
/// each contact its two blocks. A contact rests while its blocks do. Threads share the contacts within groups
/// of blocks; those between groups come after them.
class ContactRelaxation {
 public:
  /// Moves d, where the contacts exert these forces and leave this residual, and the forces, until hardly a
  /// contact changes its state any more. Returns the number of sweeps; -1: a block's matrix has no inverse.
  int relax(FrictionProblem& problem, const BlockGroups& groups, const std::vector<ContactTerm>& terms,
            const std::vector<RelaxedLaw>& laws, const VectorXd& residual, VectorXd& d,
            std::vector<ContactForce>& forces);

 private:
  /// A contact for one of its blocks, with how its forces move that: columns of A^-1 G^T, of the gap and then
  /// of the slip.
  struct Side {
    int block = -1, first = 0, n = 0;  ///< -1: none, or held; its unknowns
    int first_entry = 0, n_entries = 0;
    std::size_t first_answer = 0;
    int seen = -1;  ///< moves of the block when the contact was last looked at
  };
  struct Local {
    int contact;
    std::array<Side, 2> sides;
    bool unilateral, slides, sheared;
    double normal, mixed, shear;  ///< G A^-1 G^T
    double normal_compliance, tangential_compliance;
    double reach;    ///< the gap at which the normal force is 0
    double tension;  ///< a bond's strength
    GapSlip start;   ///< at the displacements that relaxation starts from
    RelaxedLaw law;
  };

  static ContactForce solve(const Local& local, const GapSlip& own, const ContactForce& before);

  bool set_block(FrictionProblem& problem, const BlockGroups& groups, const std::vector<ContactTerm>& terms,
                 int block);
  /// Whether the contact has changed its state.
  bool look_at(Local& local, ContactForce& force);

  std::vector<Local> locals_;  ///< those within a group, group by group; then those between groups
  std::vector<int> first_of_group_;
  std::vector<int> local_of_;  ///< of each contact, -1: it touches no block that moves
  std::vector<SideEntry> entries_;
  std::vector<double> answers_;
  std::vector<int> moves_;  ///< of each block so far
  VectorXd change_;         ///< packed
};

}  // namespace ddacontact
