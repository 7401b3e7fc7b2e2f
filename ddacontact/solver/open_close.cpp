#include <ddacontact/solver/open_close.hpp>

#include <ddacontact/solver/anderson.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

struct StateChanges {
  bool opening = false;  ///< between open and closed
  bool sliding = false;  ///< between stick and the two senses of slip
  int last = -1;         ///< the contact that changed last, opening before sliding

  bool any() const { return opening || sliding; }
};

/// Moves contacts to the state that agrees with d: all of them, or the first that disagrees. A bond is lost on
/// sliding or opening.
StateChanges update_states(const VectorXd& d, bool only_first, std::vector<Contact>& contacts) {
  StateChanges changes;
  for (std::size_t c = 0; c < contacts.size() && !(only_first && changes.any()); ++c) {
    Contact& contact = contacts[c];
    ContactHistory& history = contact.history;
    const Trial trial{.gap = contact.gap(d) - history.gap_offset,
                      .slip = contact.slip(d),
                      .slip_increment = contact.slip.change(d),
                      .tolerance = contact.length_tolerance,
                      .bonded = history.bonded};
    const ContactState state = next_state(history.state, contact.law, trial);
    if (state == history.state) continue;
    const bool opens_or_closes = (state == ContactState::open) != (history.state == ContactState::open);
    if (opens_or_closes || !changes.opening) changes.last = static_cast<int>(c);
    (opens_or_closes ? changes.opening : changes.sliding) = true;
    history.state = state;
    history.bonded = history.bonded && state == ContactState::stick;
    contact.was_closed = contact.was_closed || contact.closed();
  }
  return changes;
}

bool has_friction_to_find(const std::vector<Contact>& contacts) {
  return std::any_of(contacts.begin(), contacts.end(), [](const Contact& contact) {
    return is_slipping(contact.history.state) && contact.law.friction > 0;
  });
}

/// Friction of a pass counts as found when the residual fell by this, and when it is below tolerance.
constexpr double sufficient_decrease = 1e-3;
constexpr int anderson_depth = 8;

}  // namespace

OpenCloseReport iterate_open_close(StepSystem& system, const OpenCloseOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d) {
  OpenCloseReport report;
  Residual& r = report.residual;
  for (Contact& contact : contacts) contact.was_closed = contact.closed();
  d = system.prescribed();
  system.compute_residual(d, contacts, r);
  AndersonAcceleration acceleration(anderson_depth);
  VectorXd correction;

  for (int pass = 0; pass < options.max_passes && report.iterations < options.max_iterations; ++pass) {
    if (!system.factorize(contacts)) {
      report.status = OpenCloseStatus::not_positive_definite;
      return report;
    }
    const bool friction_to_find = has_friction_to_find(contacts);
    const double before = r.largest;
    do {
      system.solve(r.force, correction);
      acceleration.advance(-correction, system.unknown_lengths(), d);
      ++report.iterations;
      system.compute_residual(d, contacts, r);
      if (!std::isfinite(r.largest)) {
        report.status = OpenCloseStatus::not_finite;
        return report;
      }
    } while (friction_to_find && !r.balanced(options.residual_tolerance) && r.largest > sufficient_decrease * before &&
             report.iterations < options.max_iterations);

    const StateChanges changes = update_states(d, pass >= options.full_passes, contacts);
    report.last_changed = changes.last;
    if (changes.any()) {
      acceleration.reset();
      system.compute_residual(d, contacts, r);
    } else if (r.balanced(options.residual_tolerance)) {
      report.status = OpenCloseStatus::settled;
      return report;
    }
    report.status = changes.opening ? OpenCloseStatus::unsettled : OpenCloseStatus::friction_unsettled;
  }
  return report;
}

}  // namespace ddacontact
