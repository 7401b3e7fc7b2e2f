/// \file Where the energy goes, step by step.
#pragma once

namespace ddacontact {

/// J per metre of thickness. Each entry is computed from its own definition, none as what remains.
struct Energy {
  double kinetic = 0;
  double elastic = 0;  ///< of the blocks, of closed contacts' springs, of holding springs and of bolts
  double gravity = 0;  ///< potential relative to the start
  double friction_dissipated = 0;
  double numerical_dissipated = 0;  ///< the time scheme's own identity, with velocities set to zero
  double external = 0;              ///< work of loads and supports
  double damping_dissipated = 0;
  double pushed_out = 0;          ///< put in by contacts that push penetration out
  double plastic_dissipated = 0;  ///< by bolts that yield, slip in their bond or tear

  double total() const {
    return kinetic + elastic + gravity + friction_dissipated + numerical_dissipated + damping_dissipated +
           plastic_dissipated - external - pushed_out;
  }
};

/// The energies of a run, and how well they close.
class EnergyLedger {
 public:
  Energy now;

  /// Takes the present energies as those of the start.
  void start() { start_ = now; }
  /// Notes the present energies as exchanged; call after every step.
  /// \param[in] tolerated  work that contacts may do while they close the penetration that their tolerance
  ///                       leaves, J per m: it counts as no rise
  void close_step(double tolerated = 0);
  /// (total - total at the start) / the largest energy exchanged so far; 0 while there was none but what the
  /// residuals of steps make of the largest energy.
  double balance_error() const;
  /// The largest change of any entry since the start, J per m.
  double exchanged() const { return exchanged_; }
  /// Whether exchanged() is more than what residuals make of the largest energy.
  bool has_exchanged() const;
  /// The most that contacts have put in within one step as they pushed penetration out, beyond what is
  /// tolerated, J per m.
  double pushed_at_once() const { return pushed_at_once_; }

  /// Energy from nowhere: by how much kinetic, elastic, gravity and what friction and damping took rose above
  /// the work of loads and supports at most, beyond what is tolerated, over the largest energy exchanged; 0
  /// while there was none. What two steps in sequence end with counts: where the velocity of a support jumps,
  /// that at the end of the step is the mean of both sides.
  double created() const;

  /// Calls visit with every number of the ledger.
  template <class Ledger, class Visit>
  static void visit_numbers(Ledger& ledger, Visit&& visit) {
    for (auto* energy : {&ledger.now, &ledger.start_})
      for (double Energy::*entry : entries) visit(energy->*entry);
    for (auto* number : {&ledger.exchanged_, &ledger.largest_, &ledger.tolerated_, &ledger.created_,
                         &ledger.created_last_, &ledger.pushed_at_once_, &ledger.pushed_before_})
      visit(*number);
  }

 private:
  static constexpr double Energy::*entries[] = {&Energy::kinetic,
                                                &Energy::elastic,
                                                &Energy::gravity,
                                                &Energy::friction_dissipated,
                                                &Energy::numerical_dissipated,
                                                &Energy::external,
                                                &Energy::damping_dissipated,
                                                &Energy::pushed_out,
                                                &Energy::plastic_dissipated};

  Energy start_;
  double exchanged_ = 0, largest_ = 0, tolerated_ = 0;
  double created_ = 0, created_last_ = 0;          ///< at most, and as the last step ended, J per m
  double pushed_at_once_ = 0, pushed_before_ = 0;  ///< at most in a step, and until the last one, J per m
};

}  // namespace ddacontact
