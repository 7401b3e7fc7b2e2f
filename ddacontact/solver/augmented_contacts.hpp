/// \file The contacts of a step by augmented Lagrangian multipliers: N = max(0, lambda - p g), T = tau - p_t
/// s within what friction bears under N. Each is as stiff as the blocks behind it allow; what a stiffness
/// gives way is made good by its multiplier.
#pragma once

#include <ddacontact/solver/contact_solver.hpp>
#include <ddacontact/solver/spring_state.hpp>
#include <ddacontact/solver/step_problem.hpp>
#include <ddacontact/solver/swept_law.hpp>

#include <vector>

namespace ddacontact {

/// Multipliers of a contact, N per m, and its data that do not change within a solution.
struct Multiplier {
  double normal = 0, shear = 0;
  double gap = 0;  ///< the constant of the term's gap, the offset not taken off
  bool bonded = false;
  bool acts = false;  ///< the vertex meets the edge in the step
};

/// The contacts of one step: their terms, springs and states where the solution is looked for, and the forces
/// that it gives them.
class AugmentedContacts {
 public:
  AugmentedContacts(const StepProblem& system, const ContactSolverOptions& options,
                    std::vector<Contact>& contacts);

  /// Stiffnesses and multipliers at the start of the step.
  void begin();
  /// Forces become those of the problem that differs little, or of the step before.
  void take_first_forces();
  /// Lets contacts act whose vertices d leads over their edges and past their lines, for the rest of the step:
  /// at the end of an edge what its own force does to a contact may not decide whether it acts. The terms are
  /// those at d. False: there are none.
  bool add_met(VectorXd& d);
  /// Makes the terms at d, geometry included. Prescribed unknowns of d are set.
  void evaluate(VectorXd& d);
  /// Makes the springs of the terms at d, and with them the states of the law.
  void find_springs(const VectorXd& d);
  /// The states of the law become those in which contacts exert their forces.
  void take_states_of_forces();
  /// N and T become the multipliers.
  void raise_multipliers(const VectorXd& d);

  /// Whether closed contacts touch and sticking ones stay within so many penetration tolerances; if not,
  /// `worst` is the furthest.
  bool are_close(const VectorXd& d, double tolerances, int& worst) const;
  /// Whether a contact that is open is behind its line by no more than gaps of closed ones that stay uncorrected.
  bool hardly_penetrates(std::size_t c, const VectorXd& d) const;
  /// Breaks the bonds that bear their strength and give way: they act no more within this step. False: none
  /// does.
  bool break_bonds(const VectorXd& d);
  /// Forces and states become those of the contacts.
  /// \param[in] negligible  allowed violation of complementarity, N per m
  void settle(double negligible);
  /// Gaps and slips at d become those of the contacts.
  void end(const VectorXd& d);

  /// Laws of the contacts for sweeps and the interior-point method.
  std::vector<SweptLaw> laws() const;
  /// Friction that follows normal forces where contacts have these states.
  std::vector<Coupling> couplings(const std::vector<unsigned char>& states) const;
  /// Force in a state where the springs are evaluated, N per m.
  ContactForce force_in(unsigned char state, std::size_t c) const {
    return force_in_state(contacts_[c].law, multipliers_[c].bonded, state, springs_[c]);
  }
  ContactForce law_force(std::size_t c) const {
    return {springs_[c].normal.clipped(), springs_[c].tangential.clipped()};
  }

  std::size_t size() const { return contacts_.size(); }
  const std::vector<Contact>& contacts() const { return contacts_; }
  bool is_bonded(std::size_t c) const { return multipliers_[c].bonded; }
  const std::vector<ContactTerm>& terms() const { return terms_; }
  std::vector<ContactTerm>& terms() { return terms_; }
  /// States of the law where the springs are evaluated.
  const std::vector<unsigned char>& law_states() const { return law_states_; }
  /// Contact forces, N per m; any that the solution tries.
  const std::vector<ContactForce>& forces() const { return forces_; }
  std::vector<ContactForce>& forces() { return forces_; }

 private:
  void begin(Contact& contact, Multiplier& multiplier) const;
  void begin_compliant(const Contact& contact, Multiplier& multiplier) const;
  void evaluate(const Contact& contact, const VectorXd& displaced, const VectorXd& d, Multiplier& multiplier,
                ContactTerm& term) const;
  bool has_means() const { return options_.directions == Directions::mean; }
  double shear_stiffness(const JointLaw& law) const {
    return law.tangential_stiffness * (law.compliant && has_means() ? 1. / 2 : 1);
  }
  /// Schemes that damp nothing.
  bool leaves_gaps() const { return has_means() || system_.is_explicit(); }
  double kept(double length, int halvings, double size) const;
  bool yields(std::size_t c, const VectorXd& d) const;
  bool is_sliding(std::size_t c) const { return law_states_[c] & (at_upper | at_lower); }
  double elastic_normal(std::size_t c, const VectorXd& d) const;
  double gap_at(std::size_t c, const VectorXd& d) const {
    return multipliers_[c].gap + terms_[c].gap.change(d);
  }

  const StepProblem& system_;
  const ContactSolverOptions& options_;
  std::vector<Contact>& contacts_;
  std::vector<Multiplier> multipliers_;
  std::vector<ContactTerm> terms_;
  std::vector<ContactSprings> springs_;
  std::vector<unsigned char> law_states_;
  std::vector<ContactForce> forces_;
};

}  // namespace ddacontact
