#include <ddacontact/classic/open_close.hpp>

#include <ddacontact/classic/spring_law.hpp>
#include <ddacontact/solver/anderson.hpp>
#include <ddacontact/solver/contact_solver.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// A contact whose state does not agree with the solution.
struct Disagreement {
  std::size_t contact;
  ContactState state;  ///< the one that agrees
  double force;        ///< by how much it does not, N per m
};

bool opens_or_closes(ContactState from, ContactState to) {
  return (from == ContactState::open) != (to == ContactState::open);
}

/// The force that the old state gets wrong: that of a gap or a slip which should
/// not be, or what exceeds a bound.
double wrong_force(const Contact& contact, ContactState state, const Trial& trial) {
  const JointLaw& law = contact.law;
  if (opens_or_closes(contact.history.state, state)) return std::abs(normal_force(law, trial.gap));
  if (is_slipping(contact.history.state)) return law.tangential_stiffness * std::abs(trial.slip_increment);
  return law.tangential_stiffness * std::abs(trial.slip) -
         shear_bound(law, normal_force(law, trial.gap), trial.bonded);
}

std::vector<Disagreement> find_disagreements(const VectorXd& d, const std::vector<Contact>& contacts,
                                             const std::vector<ContactTerm>& terms) {
  std::vector<Disagreement> found;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    const double slip = terms[c].slip(d);
    const Trial trial{.gap = terms[c].gap(d) - contact.history.gap_offset,
                      .slip = slip,
                      .slip_increment = terms[c].slip.change(d),
                      .tolerance = contact.length_tolerance(),
                      .on_edge = contact.is_on_edge(terms[c].slip.constant) || contact.is_on_edge(slip),
                      .bonded = contact.has_bond()};
    const ContactState state = next_state(contact.history.state, contact.law, trial);
    if (state != contact.history.state) found.push_back({c, state, wrong_force(contact, state, trial)});
  }
  return found;
}

/// With `breaking` a contact that comes back from an open or slipping state has lost its bond.
void change_states(const std::vector<Disagreement>& disagreements, bool breaking,
                   std::vector<Contact>& contacts) {
  for (const Disagreement& of : disagreements) {
    Contact& contact = contacts[of.contact];
    if (breaking && contact.history.state != ContactState::stick) contact.history.bonded = false;
    contact.history.state = of.state;
    contact.was_closed = contact.was_closed || contact.closed();
  }
}

/// Which of the disagreeing states to change: all while their number falls; then those alone that are wrong
/// by the largest forces, fewer the longer it does not. Changing all of them every time can go round in
/// circles.
struct Restraint {
  /// Leaves in `disagreements` what is to change.
  void apply(std::vector<Disagreement>& disagreements) {
    passes_without_gain = disagreements.size() < fewest ? 0 : passes_without_gain + 1;
    fewest = std::min(fewest, disagreements.size());
    const double part = 1 - std::ldexp(1, -passes_without_gain / patience);
    const auto less = [](const Disagreement& a, const Disagreement& b) { return a.force < b.force; };
    const double largest = std::ranges::max_element(disagreements, less)->force;
    std::erase_if(disagreements, [&](const Disagreement& of) { return of.force < part * largest; });
  }

  static constexpr int patience = 6;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  int passes_without_gain = 0;
};

/// Forces of the contacts in their states: springs (40), (48) and friction (52) from the penetration at d.
std::vector<ContactForce> forces_in_states(const std::vector<Contact>& contacts,
                                           const std::vector<ContactTerm>& terms, const VectorXd& d) {
  std::vector<ContactForce> forces(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const Contact& contact = contacts[c];
    if (!contact.closed()) continue;
    const double spring = normal_force(contact.law, terms[c].gap(d) - contact.history.gap_offset);
    const double dashpot = -contact.damping * terms[c].gap.change(d);
    forces[c].normal = spring + std::max(dashpot, -std::max(spring, 0.0));  // a dashpot does not pull
    const double sign = slip_sign(contact.history.state);
    forces[c].shear = sign != 0 ? -sign * shear_bound(contact.law, forces[c].normal, false)
                                : -contact.law.tangential_stiffness * terms[c].slip(d);
  }
  return forces;
}

std::vector<unsigned char> springs_in_states(const std::vector<Contact>& contacts) {
  std::vector<unsigned char> springs;
  for (const Contact& contact : contacts)
    springs.push_back(!contact.closed()                              ? none_acts
                      : contact.history.state == ContactState::stick ? all_act
                                                                     : normal_acts);
  return springs;
}

/// What the matrix needs of the contacts.
std::vector<ContactTerm> terms_of(const std::vector<Contact>& contacts) {
  std::vector<ContactTerm> terms;
  for (const Contact& contact : contacts) {
    ContactTerm term;
    term.gap = contact.motion.form(contact.first_gap());
    term.slip = contact.motion.form(contact.first_slip());
    term.normal_stiffness = contact.law.normal_stiffness + contact.damping;
    term.tangential_stiffness = contact.law.tangential_stiffness;
    terms.push_back(term);
  }
  return terms;
}

/// Solutions of (13) in a trial step and in one pass, and what may be left of the residual's scale.
constexpr int max_iterations = ContactSolverOptions{}.max_solutions, max_iterations_per_pass = 30;
constexpr double residual_tolerance = ContactSolverOptions{}.residual_tolerance;
/// Friction of a pass counts as found when the residual fell by this, and when it is below tolerance.
constexpr double sufficient_decrease = 1e-3;

/// One trial step.
struct OpenClose {
  StepSystem& system;
  const std::vector<ContactTerm>& terms;
  std::vector<Contact>& contacts;
  VectorXd& d;
  ContactSolverReport report{};
  AndersonAcceleration acceleration{};
  Restraint restraint{};
  VectorXd correction{};

  ContactSolverReport iterate() {
    report.status = SolutionStatus::states_unsettled;
    for (Contact& contact : contacts) contact.was_closed = contact.closed();
    system.problem().contacts_changed();
    d = system.prescribed();
    system.linearize(d);
    compute_residual();
    while (report.iterations < max_iterations && solve_pass() && check_states()) {
    }
    return report;
  }

  void compute_residual() {
    system.compute_residual(d, contacts, terms, forces_in_states(contacts, terms, d), report.residual);
  }

  /// The displacements of these states, with the friction that they lead to. False: there are none.
  bool solve_pass() {
    if (!system.problem().factorize(terms, springs_in_states(contacts))) {
      report.status = SolutionStatus::not_positive_definite;
      return false;
    }
    const bool friction_to_find = std::ranges::any_of(contacts, [](const Contact& contact) {
      return is_slipping(contact.history.state) && contact.law.has_friction();
    });
    const Residual& r = report.residual;
    const double before = r.largest;
    const int last = std::min(max_iterations, report.iterations + max_iterations_per_pass);
    do {
      system.problem().solve(r.force, correction);
      d -= correction;
      acceleration.advance(correction.cwiseProduct(system.unknown_lengths()), d);
      if (system.rule().has_half_steps())
        (void)system.displacement(d);  // held points of blocks that turn stay where they are
      ++report.iterations;
      compute_residual();
      if (!std::isfinite(r.largest)) {
        report.status = SolutionStatus::not_finite;
        return false;
      }
    } while (friction_to_find && !r.balanced(residual_tolerance) &&
             r.largest > sufficient_decrease * before && report.iterations < last);
    return true;
  }

  /// Whether to go on, with other states where they disagree with the displacements.
  bool check_states() {
    std::vector<Disagreement> disagreements = find_disagreements(d, contacts, terms);
    if (disagreements.empty() && report.residual.balanced(residual_tolerance)) {
      report.status = SolutionStatus::settled;
      return false;
    }
    const auto opening = std::ranges::find_if(disagreements, [&](const Disagreement& of) {
      return opens_or_closes(contacts[of.contact].history.state, of.state);
    });
    const bool any = opening != disagreements.end();
    report.status = any ? SolutionStatus::states_unsettled : SolutionStatus::friction_unsettled;
    report.worst_contact = -1;
    if (disagreements.empty()) return true;
    report.worst_contact = static_cast<int>((any ? *opening : disagreements.front()).contact);
    restraint.apply(disagreements);
    // Nothing was gained for so long that cutting the step is cheaper.
    if (restraint.passes_without_gain == restraint.patience * restraint.patience) return false;
    // Bonds that come and go within a step may leave no state that agrees: a bonded contact carries shear at
    // no normal force, an open one does not.
    change_states(disagreements, restraint.passes_without_gain >= 2, contacts);
    acceleration.reset();
    compute_residual();
    return true;
  }
};

}  // namespace

ContactSolverReport iterate_open_close(StepSystem& system, std::vector<Contact>& contacts, VectorXd& d) {
  const std::vector<ContactTerm> terms = terms_of(contacts);
  ContactSolverReport report = OpenClose{system, terms, contacts, d}.iterate();
  const std::vector<ContactForce> forces = forces_in_states(contacts, terms, d);
  assert(report.status != SolutionStatus::settled || report.residual.balanced(residual_tolerance));
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    contacts[c].normal = forces[c].normal;
    contacts[c].shear = forces[c].shear;
    contacts[c].gap = terms[c].gap(d);
    contacts[c].gap_change = terms[c].gap.change(d);
    contacts[c].slip_change = terms[c].slip.change(d);
    contacts[c].end_slip = terms[c].slip(d);
  }
  return report;
}

}  // namespace ddacontact
