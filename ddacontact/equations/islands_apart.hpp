/// \file Blocks that do not touch, solved apart: each island converges on its own.
#pragma once

#include <ddacontact/block/system_part.hpp>
#include <ddacontact/equations/step_system.hpp>
#include <ddacontact/solver/contact_solver.hpp>
#include <polyfem/assembly/cholesky.hpp>

#include <memory>
#include <vector>

namespace ddacontact {

/// The systems of a step's islands: blocks that may change, joined by contacts that are closed or may close.
/// Blocks without any contact are one island together. Kept from step to step while islands are the same.
class IslandsApart {
 public:
  /// Divides the blocks into islands; false: there are not two of them.
  bool divide(const BlockSystem& blocks, const std::vector<Contact>& contacts);
  /// Solves the step as solve_contacts does, island by island, each by its own system.
  /// \param[in] whole  with the step begun
  /// \param[in,out] d  of all unknowns; where to start
  /// \return the largest counts of any island, the worst of their residuals, and the first failure
  ContactSolverReport solve(const BlockState& state, const StepStart& start, const StepSystem& whole,
                            const ContactSolverOptions& options, std::vector<Contact>& contacts, VectorXd& d);
  /// Forgets the systems: blocks have other numbers, or others take part.
  void clear() { islands_.clear(); }

  /// Work on factors in the last call of `solve`, in all islands.
  const polyfem::CholeskyWork& last_work() const { return work_; }

 private:
  /// A part of the whole with its own system.
  struct Island {
    std::vector<int> blocks;    ///< and those at rest that they may touch, ascending
    std::vector<int> contacts;  ///< of the step
    BlockSystem::Part part;
    StepSystem system{part.system()};

    Island(const BlockSystem& whole, const std::vector<int>& of_blocks, const std::vector<char>& resting)
        : blocks(of_blocks), part(whole, of_blocks, resting) {}
    /// Of the part's unknowns.
    VectorXd of_part(const VectorXd& of_all) const { return of_all(part.unknowns()); }
    Contact to_part(Contact contact) const;
    /// Adds how the contact solver ended in the part to what is reported of the whole.
    void add_to(ContactSolverReport& report, const ContactSolverReport& of_own) const;
  };

  std::vector<std::unique_ptr<Island>> islands_;  ///< by their first blocks
  polyfem::CholeskyWork work_;
};

}  // namespace ddacontact
