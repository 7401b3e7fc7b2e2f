#include <ddacontact/solver/open_close.hpp>

#include <limits>

namespace ddacontact {

namespace {

struct StateChanges {
  bool opening = false;  ///< between open and closed
  bool sliding = false;  ///< between stick and the two senses of slip
  int last = -1;         ///< the contact that changed last, opening before sliding
};

/// Moves every contact to the state that agrees with d. A bond is lost on sliding or opening.
StateChanges update_states(const VectorXd& d, std::vector<Contact>& contacts) {
  StateChanges changes;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
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

}  // namespace

OpenCloseReport iterate_open_close(StepSystem& system, const OpenCloseOptions& options,
                                   std::vector<Contact>& contacts, VectorXd& d) {
  OpenCloseReport report;
  for (Contact& contact : contacts) contact.was_closed = contact.closed();
  d = system.prescribed();
  system.compute_residual(d, contacts, report.residual);
  while (report.iterations < options.max_iterations) {
    if (!system.factorize(contacts)) {
      report.status = OpenCloseStatus::not_positive_definite;
      return report;
    }
    system.correct(report.residual.force, d);
    ++report.iterations;
    const StateChanges changes = update_states(d, contacts);
    report.last_changed = changes.last;
    system.compute_residual(d, contacts, report.residual);
    const Residual& r = report.residual;
    if (!(r.largest < std::numeric_limits<double>::infinity())) {
      report.status = OpenCloseStatus::not_finite;
      return report;
    }
    const bool balanced = r.largest <= options.residual_tolerance * r.scale + r.floor;
    if (!changes.opening && !changes.sliding && balanced) {
      report.status = OpenCloseStatus::settled;
      return report;
    }
    report.status = changes.opening ? OpenCloseStatus::unsettled : OpenCloseStatus::friction_unsettled;
  }
  return report;
}

}  // namespace ddacontact
