#include <ddacontact/solver/swept_step.hpp>

#include <ddacontact/solver/contact_sweeps.hpp>

namespace ddacontact {

namespace {

/// Sweeps on one linearized geometry, and linearizations.
constexpr int most_sweeps = 1000, most_rounds = 12;
/// The tolerance of the last sweep over that of the step: the remaining error exceeds its change. And its change
/// over that of the first, so that what no tolerance sees does not grow.
constexpr double part_of_last_sweep = 0.1, reduction = part_of_last_sweep * part_of_last_sweep;
/// A coarse step has many changes when more than this part of the contacts, and more than this number, change
/// state in its first two sweeps. It accepts this multiple of the penetration tolerance.
constexpr double many_changes = 0.08;
constexpr int few_changes = 10;
constexpr double coarse_penetration = 10;

/// Whether gaps follow their gradients of the start on the last part of the way to d, `change`, as far as
/// forces can tell, and held points stay where they are.
bool stays_straight(const StepProblem& system, const AugmentedContacts& contacts, const VectorXd& d,
                    const VectorXd& change, const std::vector<SweptLaw>& laws, double tolerance) {
  const std::optional<std::vector<double>> bends = system.bends(d, change);
  if (!bends) return false;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const VertexEdge& pair = contacts.contacts()[c].pair;
    const double bend = (*bends)[pair.vertex_block] + (*bends)[pair.edge_block];
    if (contacts.terms()[c].normal_stiffness * bend > tolerance * laws[c].scale) return false;
  }
  return true;
}

}  // namespace

bool solve_by_sweeps(StepProblem& system, const ContactSolverOptions& options, AugmentedContacts& contacts,
                     VectorXd& d, ContactSolverReport& report) {
  std::vector<ContactForce>& forces = contacts.forces();
  contacts.take_first_forces();
  const auto compute_residual = [&] {
    system.compute_residual(d, contacts.contacts(), contacts.terms(), forces, report.residual);
  };
  const ContactSweeps::Tolerance tight{part_of_last_sweep * options.sweep_tolerance},
      coarse{options.sweep_tolerance, coarse_penetration}, any{inf, inf};
  const double negligible = options.local ? part_of_last_sweep * options.residual_tolerance : inf,
               many = options.coarse ? many_changes : inf;
  ContactSweeps::Stop stop{
      options.local ? tight : any, coarse, many, few_changes, most_sweeps, reduction, negligible};
  ContactSweeps sweeps;
  bool changes_many = false;
  for (int round = 0; round < most_rounds; ++round) {
    compute_residual();
    if (round == 0 || !options.keeps_gradients()) {
      if (round > 0) system.linearize(d);
      if (!sweeps.set(system.problem(), contacts.terms())) return false;
    }
    VectorXd swept_d = d;
    const std::vector<SweptLaw> laws = contacts.laws();
    const ContactSweeps::Report swept =
        sweeps.sweep(contacts.terms(), laws, report.residual.force, stop, swept_d, forces);
    report.sweeps += swept.sweeps;
    if (swept.many_changes) {
      changes_many = true;
      stop.quiet = coarse;
    }
    if (!options.local && !changes_many) return false;
    if (!swept.settled) break;  // d stays as it was: where sweeps do not converge they lead anywhere
    const VectorXd change = swept_d - d;
    system.move(change, d);
    const bool is_straight =
        options.keeps_gradients() && stays_straight(system, contacts, d, change, laws, stop.quiet.force);
    if (!is_straight) contacts.evaluate(d);
    contacts.find_springs(d);
    contacts.take_states_of_forces();
    if (contacts.add_met(d) || (!is_straight && (round == 0 || swept.sweeps > (changes_many ? 2 : 1))))
      continue;
    if (contacts.are_close(d, changes_many ? coarse_penetration : 1, report.worst_contact)) {
      compute_residual();
      report.tolerance = options.sweep_tolerance;
      // Where forces of blocks are not linear sweeps are Newton's steps.
      if (report.residual.block_relative <=
          (options.keeps_gradients() ? report.tolerance : options.residual_aim))
        return true;
      continue;
    }
    contacts.raise_multipliers(d);
    ++report.augmentations;
    contacts.evaluate(d);
  }
  ++report.sweep_fallbacks;
  return false;
}

}  // namespace ddacontact
