/// \file One trial of a step: its contacts, and the motion and forces that solve it.
#pragma once

#include <ddacontact/classic/open_close.hpp>
#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/equations/islands_apart.hpp>
#include <ddacontact/solver/contact_solver.hpp>
#include <ddacontact/time/impacts.hpp>
#include <ddacontact/time/participants.hpp>
#include <ddacontact/time/step_counts.hpp>
#include <ddacontact/time/step_from.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// Seconds spent, by phase.
struct StepTimes {
  double detection = 0, assembly = 0, solver = 0, update = 0;
  double analysis = 0, factorization = 0, solution = 0;  ///< of the solver, on the factors of (13)
  long analyses = 0;  ///< of the pattern of (13); going on from a record takes one more
};

/// The solution of a trial, its residual, and the reason to reject it (empty: none).
struct TrialSolution {
  VectorXd d;         ///< of all unknowns
  VectorXd straight;  ///< the solution: with half steps the straight motion, see Block::displacement
  Residual residual;
  double tolerance = 0;  ///< to which contact forces were solved
  std::string rejection;
  bool friction_unsettled = false;  ///< the only reason to reject it
  StepImpact impact;
  VectorXd start;  ///< where d was looked for from, without an earlier solution

  /// Displacements from where the blocks are at the start of the step.
  VectorXd motion() const { return impact.changes() ? VectorXd(d + impact.shift) : d; }
};

/// State of the blocks after a solution.
struct TrialEnd {
  BlockState state;
  std::string rejection;     ///< why a block does not survive the step; empty: all do
  std::vector<int> concave;  ///< blocks whose outlines are not convex there
};

/// Finds the contacts of blocks in a state, and solves steps that begin there: impacts first, then forces and
/// motion by the contact method, again where corners meet other edges than those chosen.
class TrialStep {
 public:
  /// Keeps references: a trial uses the arguments as they are when it is made. When others take part pairs are
  /// to be forgotten and the system is to be made.
  /// \param[in] last  contacts of the last accepted substep
  /// \param[in,out] counts  what solutions take is added
  TrialStep(const Participants& participants, const std::vector<ContactRecord>& last,
            const AnalysisOptions& analysis, const ContactProperties& properties, StepCounts& counts);

  /// Forgets pairs of blocks that may meet: blocks have other numbers, or others take part.
  void forget_pairs(const ContactProperties& properties) { builder_.emplace(blocks(), properties); }
  /// Forgets the systems of islands: their loads, water and supports are those of the last stage.
  void forget_islands() { islands_.clear(); }
  /// Makes the system (13) anew, for the blocks that take part now.
  void make_system();

  /// Looks for the contacts of the next step, of blocks that have made one.
  /// \param[in] margin       how far from each block, m
  /// \param[in] doubts  whether corners that hold blocks by what they met before are asked which way they would go
  void detect(double dt, const std::vector<double>& margin, bool doubts);
  /// Looks for the contacts of blocks that have not made a step.
  /// \param[in] coming  see ContactBuilder::build_first
  void detect_first(double dt, const std::vector<double>& margin, const std::vector<int>& coming = {});
  /// Solves the step of length dt, s, that begins now, with the contacts found.
  TrialSolution solve(double dt);
  /// State of the blocks at the end of that step.
  TrialEnd advance(double dt, const TrialSolution& solution) const;
  /// Takes in the contacts that let a vertex into a block on its way to `next`. False: there are none.
  bool take_missed(const BlockState& next);

  const AnalysisOptions& analysis() const { return analysis_; }
  /// Contacts of the trial, as the last solution left them.
  std::vector<Contact>& contacts() { return contacts_; }
  ContactBuilder& builder() { return *builder_; }
  /// System of the step, begun as the last solution left it.
  const StepSystem& system() const { return *system_; }
  bool has_system() const { return system_.has_value(); }
  ContactSolverOptions& options() { return options_; }

  /// Times of the run: those of solutions are added.
  StepTimes& times() { return times_; }
  const StepTimes& times() const { return times_; }

 private:
  /// A step is solved again so often at most: for contacts that closed fast and were not predicted, and for
  /// lines that corners meet.
  static constexpr int most_rounds = 4;

  const BlockSystem& blocks() const { return *participants_.blocks; }
  const BlockState& state() const { return *participants_.state; }
  bool is_static() const { return analysis_.mode == Mode::statics; }
  bool is_classic() const { return builder_->properties().method == ContactMethod::classic; }
  StepRule rule(double dt) const { return rule_from(analysis_, state(), dt); }
  /// Keeps the part of the contacts that a solution changes.
  void keep_start();
  /// Restores the contacts to before the last solution, if there was one.
  void restart();
  /// Displacements of all unknowns in a step from this state that velocities and supports predict.
  VectorXd predicted_motion(const BlockState& from, double dt) const;
  /// Solves with the impacts of the step.
  /// \param[in] warm_start  the solution with contacts that differ little; may be null
  TrialSolution solve_with_impacts(double dt, const TrialSolution* warm_start = nullptr);
  /// Solves with a predicted impact.
  TrialSolution solve_with(double dt, StepImpact impact, const TrialSolution* warm_start);
  /// Solves without the contacts at corners that are in doubt.
  /// \param[in] with  the solution with them
  TrialSolution solve_without(const std::vector<int>& doubtful, double dt, const TrialSolution& with);
  /// Marks in `forced` contacts that closed fast and were not predicted; false: there are none.
  bool find_unpredicted(double dt, const TrialSolution& solution, std::vector<char>& forced) const;
  /// \param[in] from  where the step starts
  ContactSolverReport solve_by_contact_solver(const StepStart& start, const BlockState& from,
                                              const TrialSolution* warm_start, TrialSolution& solution);
  void take(ContactSolverReport report, TrialSolution& solution);
  std::string between(int contact) const;
  /// Whether supports move a block of the contact.
  bool is_driven(int contact) const;
  void add(const polyfem::CholeskyWork& work);
  void set_supports(const StepRule& rule, BlockState& next) const;
  void set_support_velocities(const StepRule& rule, const VectorXd& d, BlockState& next) const;

  const Participants& participants_;
  const std::vector<ContactRecord>& last_;
  const AnalysisOptions& analysis_;
  StepCounts& counts_;
  ContactSolverOptions options_;
  std::optional<ContactBuilder> builder_;
  std::optional<StepSystem> system_;  ///< of the blocks that are present
  IslandsApart islands_;
  std::vector<Contact> contacts_;
  bool solved_ = false;  ///< contacts_ differ from those at the start of the step
  bool doubts_ = false;  ///< see `detect`
  StepTimes times_;
};

}  // namespace ddacontact
