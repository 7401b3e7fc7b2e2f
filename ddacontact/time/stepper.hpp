/// \file One time step after another: detect, solve, accept or cut.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/solver/open_close.hpp>
#include <ddacontact/solver/staged.hpp>
#include <ddacontact/time/energy_ledger.hpp>
#include <ddacontact/time/held_contacts.hpp>
#include <ddacontact/time/impacts.hpp>
#include <ddacontact/time/motion_limits.hpp>
#include <ddacontact/time/step_record.hpp>

#include <string>

namespace ddacontact {

/// What a run has done so far.
struct StepCounts {
  long steps = 0;                  ///< whole steps of the length the scene states
  long substeps = 0;               ///< accepted tries
  long rejected = 0;               ///< tries given up and made again, most of them shorter
  long overlap_rejections = 0;     ///< of these, because a vertex went into a block without a contact
  long unconverged = 0;            ///< accepted although stick and slip had not settled
  long open_close_iterations = 0;  ///< solutions of (13), in all tries
  long minimizations = 0;          ///< problems with frozen bounds that the staged method had to solve
  long augmentations = 0;
  long broken_bonds = 0;
  long impacts = 0;          ///< contacts that met with a speed that counts
  long limited_impacts = 0;  ///< impacts whose restitution was reduced so that no energy arose
  long unsettled_impacts =
      0;  ///< impacts whose friction did not agree with their normal impulses to the last
  long frictionless_holds = 0;  ///< steps whose closed contacts were held without the friction of that
  long contacts_max = 0;        ///< closed at the end of a substep, at most
  long contacts = 0;            ///< closed at the end of the last one
  double max_penetration = 0;   ///< m, at the end of any substep
  double max_residual = 0;      ///< Residual::own of any accepted substep, at most
};

/// Seconds spent, by phase.
struct StepTimes {
  double detection = 0, assembly = 0, solver = 0, update = 0;
};

/// Owns the blocks, their state and their contacts, and carries them through time.
class Stepper {
 public:
  /// \param[in] initial  the state at the start, with velocities and stresses
  Stepper(BlockSystem blocks, BlockState initial, const ContactProperties& contacts,
          const AnalysisOptions& analysis);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Carries the state over one time_step, in as many substeps as it takes. False when it has to stop: the
  /// state is then that of the last accepted substep and `stop_reason` says why.
  [[nodiscard]] bool step();

  /// Where the run stands, and going on from there: a stepper of the same scene makes the same steps then.
  StepRecord record() const;
  void restore(StepRecord record);

  /// How hard the staged method tries, for those who measure it.
  StagedOptions& staged_options() { return staged_; }

  const BlockSystem& blocks() const { return blocks_; }
  const BlockState& state() const { return state_; }
  /// Contacts of the last accepted substep, with its results; before the first step, those at the start.
  const std::vector<Contact>& contacts() const { return contacts_; }
  const EnergyLedger& energy() const { return energy_; }
  /// Forces that the supports exert at the end of the last accepted substep, N per
  /// m, 2 x all outline vertices.
  const Points& reactions() const { return reactions_; }
  const StepCounts& counts() const { return counts_; }
  const StepTimes& times() const { return times_; }
  const polyfem::Cholesky& cholesky() const { return system_.problem().cholesky(); }
  const std::string& stop_reason() const { return stop_reason_; }
  /// Where and when stick and slip had not settled in the last of the substeps counted as unconverged.
  const std::string& last_unsettled() const { return last_unsettled_; }
  /// What happened that a user should know, in the order of time: convex blocks that turned concave.
  const std::vector<std::string>& notes() const { return notes_; }
  /// The length of the last accepted substep, s.
  double last_dt() const { return last_dt_; }

 private:
  enum class Try { accepted, rejected, outran_detection, missed_contacts };

  Try try_step(double dt);
  void detect(double dt);
  /// What a try found: displacements, what they leave over, and why they cannot be accepted (empty: they
  /// can).
  struct Solution {
    VectorXd d;
    Residual residual;
    std::string objection;
    bool friction_unsettled = false;  ///< and nothing else
    StepImpact impact;
  };
  Solution solve(double dt);
  /// One try with an impact foreseen.
  Solution solve_with(double dt, const StepImpact& impact);
  /// Marks in `also` contacts that closed fast without having been foreseen; false: there are none.
  bool find_unforeseen(double dt, const Solution& solution, std::vector<char>& also) const;
  void solve_by_open_close(Solution& solution);
  void solve_by_stages(Solution& solution);
  std::string between(int contact) const;
  /// Whether outlines are still simple; notes convex ones that are no longer convex in `turned_concave_`.
  bool check_outline(int block, const BlockState& next);
  /// The next state; sets `rejection_` and returns false when a block does not survive it.
  bool advance(double dt, const Solution& solution, BlockState& next);
  void accept(double dt, const Solution& solution, BlockState next);
  /// Prepares the blocks for the new state. The integrals of the shape functions of incremental blocks change
  /// with the shape, so that the same vertex velocities would carry another momentum: free blocks are given
  /// the difference as a translation. The paper preset leaves it.
  void prepare_and_keep_momentum();
  void record_reactions(const VectorXd& d, const Residual& residual);
  void record_contacts(const VectorXd& d);
  VectorXd start_velocity() const;
  bool is_static() const { return analysis_.mode == Mode::statics; }

  BlockSystem blocks_;
  AnalysisOptions analysis_;
  MotionLimits limits_;
  ContactBuilder contact_builder_;
  StepSystem system_;
  OpenCloseOptions open_close_;
  ContactMethod method_;
  StagedOptions staged_;
  double held_stiffness_;
  HeldReport held_;  ///< of the last try

  BlockState state_;
  std::vector<Contact> contacts_;  ///< of the last accepted substep
  EnergyLedger energy_;
  Points reactions_;

  std::vector<Contact> trial_contacts_;  ///< of the present substep, at its start
  std::vector<Contact> tried_;           ///< as open-close left them
  std::vector<double> reach_;            ///< that trial_contacts_ were looked for in
  double reach_scale_ = 1;
  bool begun_ = false;     ///< a substep has been made: contacts carry on contacts_
  bool detected_ = false;  ///< trial_contacts_ are those of state_

  double substep_;  ///< the length to try next, s
  double last_dt_ = 0;
  StepCounts counts_;
  StepTimes times_;
  std::string stop_reason_, rejection_, last_unsettled_;
  std::vector<bool> convex_;         ///< outlines that have been so to this moment
  std::vector<int> turned_concave_;  ///< blocks, in the present try
  std::vector<std::string> notes_;
};

}  // namespace ddacontact
