/// \file A step's contact forces by sweeps over the contacts: each in turn is given what its law demands.
#pragma once

#include <ddacontact/solver/friction_problem.hpp>
#include <ddacontact/solver/swept_contact.hpp>

#include <array>
#include <vector>

namespace ddacontact {

/// Nonsmooth Gauss-Seidel iteration in the forces of the contacts (Moreau, Jean): displacements always
/// balance the forces, d = A^-1 (Q + sum of G_c^T f_c), and each contact in turn is given the forces that its
/// law demands while the others stay. Anderson acceleration takes the next forces from the last few sweeps.
/// A few sweeps suffice where inertia keeps the effect of a force within a step near its contact.
///
/// Threads share groups of blocks with the contacts within each; those between groups come after them. What
/// is found does not depend on the number of threads.
class ContactSweeps {
 public:
  static constexpr int largest_block = 64;  ///< unknowns
  static constexpr int group_size = 12000;  ///< blocks

  /// Takes the blocks' matrices and the contacts' gradients. False: matrices share unknowns, are larger than
  /// `largest_block`, of an odd number of unknowns, or without an inverse.
  [[nodiscard]] bool set(FrictionProblem& problem, const std::vector<ContactTerm>& terms);

  /// Largest changes of a contact in the last sweep: of its force over the scale of its law, and of its gap
  /// by that force over the gap of its law.
  struct Tolerance {
    double force, gap = 1;
  };
  /// When sweeps end.
  struct Stop {
    Tolerance quiet, many_changes;  ///< the latter where many contacts change their states
    double many = 1;                ///< as a part of the contacts, in the first two sweeps
    int few = 0;                    ///< up to so many never are many
    int most_sweeps = 1;
    /// The last change of a force over the first, unless it is negligible: a tolerance alone would leave
    /// disturbances below it what one sweep in its order makes of them, which may grow from step to step.
    double reduction = 1;
    double negligible = 0;
  };
  /// How sweeps ended.
  struct Report {
    int sweeps = 0;
    bool settled = false, many_changes = false;
  };
  /// Moves d, where the contacts exert these forces and leave this residual, and the forces, until no
  /// contact's force changes by more than the tolerance. Gradients are those of `set`.
  Report sweep(const std::vector<ContactTerm>& terms, const std::vector<SweptLaw>& laws,
               const VectorXd& residual, const Stop& stop, VectorXd& d, std::vector<ContactForce>& forces);

  int n_groups() const { return static_cast<int>(first_of_group_.size()) - 2; }

 private:
  /// The unknowns of a block that moves, in packed vectors, and where the columns of its inverse begin.
  struct Block {
    int matrix, first, n;
    std::size_t inverse;
  };
  /// Derivatives of gap and slip of a contact by two unknowns of a block, one after the other.
  struct Entry {
    int slot;
    std::array<std::array<double, 2>, 2> by;  ///< of gap and slip, by each
  };
  /// One of the blocks of a contact: where its unknowns and the columns of A^-1 G^T begin, its displacements
  /// by a unit normal force and by a unit shear force.
  struct Side {
    int block = -1, first = 0, n = 0;
    std::size_t columns = 0;
  };
  /// A contact, with its blocks.
  struct Row : SweptContact {
    int contact = 0, first_entry = 0, n_entries = 0;
    std::array<Side, 2> sides = {};       ///< of blocks that move, the earlier one first
    Vec2 relative_change = Vec2::Zero();  ///< of force and of gap as in Tolerance, by a change of 1 N per m
  };

  bool take_blocks(FrictionProblem& problem);
  void take_contacts(const std::vector<ContactTerm>& terms);
  void order_rows();
  void set_entries(const ContactTerm& term, Row& row);
  /// Sets where sweeps begin: displacements that balance this residual, and contacts with these forces.
  bool begin(const std::vector<ContactTerm>& terms, const std::vector<SweptLaw>& laws,
             const VectorXd& residual, const VectorXd& d, const std::vector<ContactForce>& forces_of_all);
  void visit(int r, Vec2& largest);
  Vec2 visit_all();
  bool has_many_changes(const Stop& stop, const Points& before);
  /// Displacements of the iterate: d so far less d at the start, packed.
  double* change() { return iterate_.data(); }
  /// Forces of the iterate: normal and shear force of each contact, in the order of rows.
  Eigen::Map<Points> forces() {
    return {iterate_.data() + unknown_.size(), 2, static_cast<Index>(rows_.size())};
  }

  std::vector<int> slot_;      ///< of every unknown in packed vectors, -1: prescribed
  std::vector<int> unknown_;   ///< at every slot, -1: prescribed
  std::vector<int> block_of_;  ///< at every slot
  std::vector<Block> blocks_;
  VectorXd inverses_;
  std::vector<Row> rows_;            ///< group by group, then those between groups
  std::vector<int> first_of_group_;  ///< rows of each group, of those between groups, and the end
  std::vector<Entry> entries_;
  VectorXd columns_;
  VectorXd iterate_;  ///< displacements, and the forces that they balance
};

}  // namespace ddacontact
