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
  IslandsApart();
  ~IslandsApart();

  /// Divides the blocks into islands; false: there are not two of them.
  bool divide(const BlockSystem& blocks, const std::vector<Contact>& contacts);
  /// Solves the step as solve_contacts does, island by island, each by its own system.
  /// \param[in] whole  with the step begun
  /// \param[in,out] d  of all unknowns; where to start
  /// \return the largest counts of any island, the worst of their residuals, and the first failure
  ContactSolverReport solve(const BlockState& state, const StepStart& start, const StepSystem& whole,
                            const ContactSolverOptions& options, std::vector<Contact>& contacts, VectorXd& d);
  /// Forgets the systems: blocks have other numbers, or others take part.
  void clear();

  /// Work on factors in the last call of `solve`, in all islands.
  const polyfem::CholeskyWork& last_work() const { return work_; }

 private:
  struct Island;

  std::vector<std::unique_ptr<Island>> islands_;  ///< by their first blocks
  polyfem::CholeskyWork work_;
};

}  // namespace ddacontact
