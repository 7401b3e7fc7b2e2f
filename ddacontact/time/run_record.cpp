#include <ddacontact/time/run_record.hpp>

#include <ddacontact/core/bytes.hpp>

#include <type_traits>

namespace ddacontact {

namespace {

/// One after another.
template <class Archive, class... Values>
void visit_all(Archive& visit, Values&... values) {
  (visit(values), ...);
}

template <class Archive, class Contact>
void visit_contact(Archive& visit, Contact& c) {
  visit_all(visit, c.pair.vertex_block, c.pair.vertex, c.pair.edge_block, c.pair.edge, c.pair.corner);
  int state = static_cast<int>(c.history.state);
  visit(state);
  if constexpr (!std::is_const_v<Contact>) c.history.state = static_cast<ContactState>(state);
  visit_all(visit, c.history.lock, c.history.gap_offset, c.history.bonded, c.history.length,
            c.history.length_beyond, c.history.halvings, c.history.normal, c.history.shear, c.since_asked,
            c.end_gap, c.end_slip, c.normal, c.shear, c.was_closed);
}

template <class Archive, class Counts>
void visit_counts(Archive& visit, Counts& c) {
  visit_all(visit, c.steps, c.substeps, c.rejected, c.overlap_rejections, c.unconverged, c.contact_iterations,
            c.linear_solves, c.factorizations, c.augmentations, c.broken_bonds, c.impacts, c.limited_impacts,
            c.unsettled_impacts, c.unknown_velocities, c.contacts_max, c.contacts, c.asleep, c.equations,
            c.sweeps, c.interior_solutions, c.solver_fallbacks, c.interior_point_solves, c.corner_solutions,
            c.unsettled_corners, c.max_penetration, c.max_residual, c.largest_tolerance);
}

template <class Archive, class SomeEquilibrium>
void visit_equilibrium(Archive& visit, SomeEquilibrium& e) {
  visit_all(visit, e.unbalanced, e.unbalanced_block, e.n_unbalanced, e.unbalanced_before, e.fastest,
            e.fastest_block, e.relative_speed, e.kinetic);
}

template <class Archive, class Record>
void visit_record(Archive& visit, Record& r) {
  visit_all(visit, r.step.steps, r.step.begun, r.step.substep, r.step.progress.stage, r.step.progress.steps);
  visit.list(r.step.progress.start_times, [&](auto& time) { visit(time); });
  visit(r.step.progress.came_to_rest);
  auto& state = r.step.state;
  visit_all(visit, state.time, state.origin, state.position, state.velocity, state.coordinates, state.carried,
            state.carried_dt, state.stress, state.rotation, state.bolts, r.step.fading.forces,
            r.step.fading.from, r.step.fading.to);
  for (auto* numbers : {&r.step.sleeping.island, &r.step.sleeping.rested})
    visit.list(*numbers, [&](auto& number) { visit(number); });
  visit.list(r.step.sleeping.around, [&](auto& box) { visit_all(visit, box.low, box.high); });
  visit.list(r.step.contacts, [&](auto& contact) { visit_contact(visit, contact); });
  visit_counts(visit, r.counts);
  EnergyLedger::visit_numbers(r.energy, visit);
  visit_all(visit, r.last_dt, r.end_time, r.zero_position, r.zero_origin, r.reactions);
  visit.list(r.convex, [&](auto& convex) { visit(convex); });
  visit.list(r.notes, [&](auto& note) { visit(note); });
  visit(r.last_unsettled);
  visit_equilibrium(visit, r.equilibrium);
  visit.list(r.stage_ends, [&](auto& end) {
    visit_all(visit, end.stage, end.steps, end.time, end.came_to_rest, end.at_rest, end.exchanged);
    visit_equilibrium(visit, end.equilibrium);
  });
  RunWarnings::visit_numbers(r.warnings, visit);
}

}  // namespace

std::string to_bytes(const RunRecord& record) {
  ByteWriter writer;
  visit_record(writer, record);
  return std::move(writer.bytes);
}

RunRecord run_record_from(std::string_view bytes) {
  ByteReader reader(bytes);
  RunRecord record;
  visit_record(reader, record);
  reader.expect_end();
  return record;
}

}  // namespace ddacontact
