/// \file One time step after another: detect, solve, accept or cut.
#pragma once

#include <ddacontact/time/contact_histories.hpp>
#include <ddacontact/time/energy_ledger.hpp>
#include <ddacontact/time/equilibrium.hpp>
#include <ddacontact/time/face_parts.hpp>
#include <ddacontact/time/run_record.hpp>
#include <ddacontact/time/run_warnings.hpp>
#include <ddacontact/time/sleeping_blocks.hpp>
#include <ddacontact/time/stable_step.hpp>
#include <ddacontact/time/stage.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ddacontact {

/// Owns the blocks, their state and their contacts, and integrates them in time.
class Stepper {
 public:
  /// Throws Error when a block has no motions (Block::shape) and the scheme carries blocks on by them, and as
  /// find_stable_step does; `step` and `restore` throw so for later stages.
  /// \param[in] initial   the state at the start, with velocities and stresses
  /// \param[in] contacts  their joints are those of the stages
  /// \param[in] stages    at least one; the last one goes on when all its steps are made
  Stepper(BlockSystem blocks, BlockState initial, const ContactProperties& contacts,
          std::vector<Stage> stages);
  /// A run of one stage.
  Stepper(BlockSystem blocks, BlockState initial, const ContactProperties& contacts,
          const AnalysisOptions& analysis)
      : Stepper(std::move(blocks), std::move(initial), contacts,
                std::vector<Stage>{{analysis, contacts.joints, {}, false, {}, {}}}) {}
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Advances the state by one time_step, in as many substeps as it takes; first enters the next stage when
  /// the present one has made its steps or its `until` holds. False when it has to stop: the state is then
  /// that of the last accepted substep and `stop_reason` says why; also where memory does not suffice for a
  /// trial step. Throws std::bad_alloc where it fails between two states: the record is of no use then.
  [[nodiscard]] bool step();
  /// Called after every trial step. Where it returns true the trials since the last accepted substep are
  /// discarded, `step` returns false and `stop_reason` is "interrupted".
  void interrupt_when(std::function<bool()> asked) { interrupted_ = std::move(asked); }

  /// The state of the run, and its restoration: a stepper of the same scene makes the same steps from there.
  /// Energy accounts begin anew. Throws Error for a record of an earlier stage than the present one, or of
  /// other blocks or stages.
  StepRecord record() const;
  void restore(StepRecord record);
  /// State of the run with all accounts, and its restoration, which throws alike.
  RunRecord run_record() const;
  void restore(RunRecord record);

  /// Limits of the contact solver, for measurements. Every stage sets its tolerance anew.
  ContactSolverOptions& contact_solver_options() { return trial_.options(); }

  const BlockSystem& blocks() const { return blocks_; }
  /// The velocity is that at the time of the state; where no next substep is solvable, that in the middle of
  /// the last one (StepCounts::unknown_velocities).
  const BlockState& state() const { return state_; }
  /// Contacts of the last accepted substep, with its results; before the first step, those at the start.
  /// Those of sleeping blocks are as they were.
  const std::vector<ContactRecord>& contacts() const { return sleepers_.contacts(); }
  /// Contacts that a step from here begins with, valid until the next step; where blocks sleep, by the numbers of
  /// those that take part.
  std::vector<Contact> contacts_to_begin_with();
  /// Properties of the contacts, with the joints of the present stage.
  const ContactProperties& contact_properties() const { return properties_; }
  const EnergyLedger& energy() const { return run_.energy; }
  /// Forces that the supports exert at the end of the last accepted substep, N per m, 2 x all points; with half
  /// steps their means over the halves of the substeps before and after. Where no next substep is solvable, or
  /// blocks meet in it whose joints have restitution, those of the last substep.
  const Points& reactions() const { return run_.reactions; }
  const StepCounts& counts() const { return run_.counts; }
  const StepTimes& times() const { return trial_.times(); }
  /// Bytes of the heap that the factor of (13) takes, while no block sleeps.
  double factor_memory() const { return trial_.system().problem().cholesky().memory(); }
  /// Whether a block sleeps: see Sleeping.
  bool is_asleep(int b) const { return sleepers_.is_asleep(b); }
  /// The present stage, or the one whose steps have all been made.
  int stage() const { return progress_.stage; }
  /// Whether the `until` of the last stage came true: the run is over before its steps are made.
  bool is_over() const {
    return progress_.came_to_rest && progress_.stage + 1 == static_cast<int>(stages_.size());
  }
  /// Forces and velocities at the end of the last accepted substep.
  const Equilibrium& equilibrium() const { return run_.equilibrium; }
  /// Whether a substep has been made, its forces are in balance and, unless it was static, its blocks move by
  /// less than 1e-6 of their size a second with less than 1e-8 of the largest energy exchanged.
  bool is_at_rest() const;
  const std::vector<Stage>& stages() const { return stages_; }
  /// How the stages before the present one ended, in their order.
  const std::vector<StageEnd>& stage_ends() const { return run_.stage_ends; }
  /// State of the present stage.
  StageEnd stage_end() const;
  /// Events that make results doubtful.
  const RunWarnings& warnings() const { return run_.warnings; }
  const std::string& stop_reason() const { return stop_reason_; }
  /// Where and when stick and slip had not settled in the last of the substeps counted as unconverged.
  const std::string& last_unsettled() const { return run_.last_unsettled; }
  /// Notes for the user in the order of time: such as blocks no longer convex, bolts torn.
  const std::vector<std::string>& notes() const { return run_.notes; }
  /// The length of the last accepted substep, s.
  double last_dt() const { return run_.last_dt; }
  /// Limit of the substeps, where the present stage is dynamic by central differences.
  const std::optional<StableStep>& stable_step() const { return stable_; }

 private:
  enum class Trial { accepted, rejected, outran_detection, missed_contacts, woke_blocks };

  /// Length of the next trial step, and the end of the time_step.
  struct Substep {
    double dt, end;
    bool is_last, is_shortest;
  };
  /// \param[in] steps_made  of the present stage
  Substep next_substep(long steps_made);
  /// The steps of one time_step; false when it has to stop.
  bool make_substeps();
  /// False when blocks that come in overlap others: `stop_reason` says which.
  bool enter_stage(int stage);
  /// Adds the contacts that blocks which come in begin with.
  void begin_contacts_of(const std::vector<int>& coming);
  /// Forces of the contacts with these blocks on the blocks that they touch, of all unknowns.
  VectorXd forces_of(const std::vector<int>& blocks) const;
  /// The longest substep of the present stage, s.
  double longest_substep() const;
  /// Applies a stage: changes the blocks and the way of stepping, but not the state.
  /// \param[in] start_time  of the stage, s
  void apply(const Stage& stage, double start_time);
  void leave_stage();
  void start_accounts();
  Trial make_trial(double dt);
  /// Whether a substep cannot be accepted with this solution.
  bool refuses(const TrialSolution& solution, double dt) const;
  /// Solves the next substep in schemes with half steps, cut until it is solvable, for the velocity at the
  /// present time lies between that in the middle of the last one and of this. Closes the accounts of the
  /// last one.
  void look_ahead(long steps_made);
  void forget_ahead();
  bool is_interrupted();
  /// Discards all trials since the last accepted substep.
  void discard_trials();
  void detect(double dt);
  /// Solution of a substep that begins now, with blocks woken and contacts looked for.
  TrialSolution find_solution(double dt);
  /// Whether blocks are carried on by their motions (BlockMotion).
  bool has_motions() const {
    return analysis_.scheme == Scheme::decaying || analysis_.scheme == Scheme::central_difference;
  }
  /// Finds the motions of the blocks in the present state, where they are carried on by them.
  void find_motions();
  void accept(double dt, const TrialSolution& solution, TrialEnd end);
  void count(const TrialSolution& solution, const ContactEnds& ends);
  void note_concave(const std::vector<int>& concave, double time);
  /// Gives the blocks their new shapes. The integrals of the shape functions of incremental blocks change
  /// with the shape, so that the same vertex velocities would carry another momentum: free blocks are given
  /// the difference as a translation. The paper preset leaves it.
  void reshape_and_keep_momentum();
  void record_reactions(const VectorXd& d, const Residual& residual);
  /// Whether the substep just made is an equilibrium, and what of it makes results doubtful.
  void assess(double dt, const TrialSolution& solution, const BlockState& next);
  bool is_static() const { return analysis_.mode == Mode::statics; }
  BlockSystem& blocks_now() const { return *participants_.blocks; }
  BlockState& state_now() const { return *participants_.state; }

  BlockSystem blocks_;
  std::vector<Stage> stages_;
  std::vector<FacePart> faces_;  ///< empty where no stage has water
  StageProgress progress_;
  AnalysisOptions analysis_;  ///< of the present stage
  MotionLimits limits_;
  ContactProperties properties_;

  BlockState state_;
  Participants participants_{&blocks_, &state_};  ///< in the step that is made
  std::vector<ContactRecord> contacts_;           ///< of the last accepted substep, of the participants
  RunAccounts run_;
  Points reactions_of_step_;

  TrialStep trial_;                    ///< of the present substep, after the last trial
  std::vector<double> search_margin_;  ///< of the last search for its contacts, m
  double margin_scale_ = 1;
  bool begun_ = false;     ///< a substep has been made: contacts carry on contacts_
  bool detected_ = false;  ///< the trial's contacts are those of state_

  std::optional<StableStep> stable_;  ///< of the present stage, by central differences
  double substep_ = 0;                ///< the length to try next, s
  /// The solution of the next substep, when it was looked for already, and the counts with it.
  struct Ahead {
    double dt;
    TrialSolution solution;
    StepCounts counts;
    double substep;  ///< cut until that was solvable
  };
  std::optional<Ahead> ahead_;
  double tolerated_work_ = 0;  ///< of contacts, see EnergyLedger::close_step
  struct {
    double substep;
    StepCounts counts;
  } accepted_;              ///< as it was after the last accepted substep
  bool accepting_ = false;  ///< the state is neither that before the substep nor that after it

  SleepingBlocks sleepers_;
  std::function<bool()> interrupted_;
  std::string stop_reason_, rejection_;
};

}  // namespace ddacontact
