/// \file One time step after another: detect, solve, accept or cut.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/solver/open_close.hpp>
#include <ddacontact/time/energy_ledger.hpp>

#include <string>

namespace ddacontact {

struct StepCounts {
  long steps = 0;                   ///< whole steps of the length the scene states
  long substeps = 0;                ///< accepted tries
  long rejected = 0;                ///< tries given up and cut
  long unconverged = 0;             ///< accepted although stick and slip had not settled
  long open_close_iterations = 0;
  long contacts_max = 0;            ///< closed at the end of a substep, at most
  long contacts = 0;                ///< closed at the end of the last one
  double max_penetration = 0;       ///< m, at the end of any substep
};

/// Seconds spent, by phase.
struct StepTimes {
  double detection = 0, assembly = 0, solver = 0, update = 0;
};

class Stepper {
 public:
  /// \param[in] initial  the state at the start, with velocities and stresses
  Stepper(BlockSystem blocks, BlockState initial, ContactProperties contacts, AnalysisOptions analysis);
  Stepper(const Stepper&) = delete;
  Stepper& operator=(const Stepper&) = delete;

  /// Carries the state over one time_step, in as many tries as it takes. False when it has to stop: the state is
  /// then that of the last accepted substep and `stop_reason` says why.
  [[nodiscard]] bool step();

  const BlockSystem& blocks() const { return blocks_; }
  const BlockState& state() const { return state_; }
  /// Contacts of the last accepted substep, with its results; before the first step, those at the start.
  const std::vector<Contact>& contacts() const { return contacts_; }
  const EnergyLedger& energy() const { return energy_; }
  /// Forces that the supports exert on the held unknowns at the end of the last accepted substep; at a vertex
  /// held by springs, the springs' force: N per m, 2 x all outline vertices.
  const Points& reactions() const { return reactions_; }
  const StepCounts& counts() const { return counts_; }
  const StepTimes& times() const { return times_; }
  const polyfem::Cholesky& cholesky() const { return system_.cholesky(); }
  const std::string& stop_reason() const { return stop_reason_; }
  /// The length of the last accepted substep, s.
  double last_dt() const { return last_dt_; }
  /// Detection reach of every block for a step of this length, m.
  std::vector<double> reach(double dt) const;

 private:
  enum class Try { accepted, rejected, outran_detection };

  Try try_step(double dt, bool last_resort);
  bool accept(double dt, const VectorXd& d, const Points& displacement, const OpenCloseReport& report);
  void account_energy(double dt, const VectorXd& d, const VectorXd& old_velocity, const VectorXd& new_velocity,
                      const Residual& residual);
  /// Names the blocks between which contact states changed last.
  std::string where(const OpenCloseReport& report) const;
  double kinetic_energy(const VectorXd& velocity) const;
  double elastic_energy() const;
  void detect(double dt);

  BlockSystem blocks_;
  AnalysisOptions analysis_;
  ContactBuilder contact_builder_;
  StepSystem system_;
  OpenCloseOptions open_close_;
  BlockState state_;
  std::vector<Contact> contacts_;       ///< of the last accepted substep
  std::vector<Contact> trial_contacts_; ///< of the present one, at its start
  std::vector<Contact> tried_;          ///< as open-close left them
  double trial_reach_scale_ = 1;
  bool detected_ = false;
  double held_stiffness_ = 0;
  double largest_displacement_ = 0;     ///< Shi's limit, m
  double substep_ = 0;                  ///< the length to try next
  double last_dt_ = 0;
  Points reactions_;
  EnergyLedger energy_;
  StepCounts counts_;
  StepTimes times_;
  std::string stop_reason_, rejection_;
};

}  // namespace ddacontact
