#include <ddacontact/time/run_record.hpp>

#include <ddacontact/core/bytes.hpp>

#include <type_traits>

namespace ddacontact {

namespace {

template <class Archive, class Contact>
void visit_contact(Archive& visit, Contact& c) {
  visit(c.pair.vertex_block);
  visit(c.pair.vertex);
  visit(c.pair.edge_block);
  visit(c.pair.edge);
  visit(c.pair.corner);
  int state = static_cast<int>(c.history.state);
  visit(state);
  if constexpr (!std::is_const_v<Contact>) c.history.state = static_cast<ContactState>(state);
  visit(c.history.lock);
  visit(c.history.gap_offset);
  visit(c.history.bonded);
  visit(c.history.length);
  visit(c.history.normal);
  visit(c.history.shear);
  visit(c.end_gap);
  visit(c.end_slip);
  visit(c.normal);
  visit(c.shear);
  visit(c.was_closed);
}

template <class Archive, class Counts>
void visit_counts(Archive& visit, Counts& c) {
  for (auto* count : {&c.steps,
                      &c.substeps,
                      &c.rejected,
                      &c.overlap_rejections,
                      &c.unconverged,
                      &c.open_close_iterations,
                      &c.linear_solves,
                      &c.factorizations,
                      &c.augmentations,
                      &c.broken_bonds,
                      &c.impacts,
                      &c.limited_impacts,
                      &c.unsettled_impacts,
                      &c.unknown_velocities,
                      &c.contacts_max,
                      &c.contacts,
                      &c.asleep,
                      &c.equations,
                      &c.sweeps,
                      &c.interior_solutions,
                      &c.solutions_with_stale_factor,
                      &c.krylov_iterations,
                      &c.solver_fallbacks,
                      &c.interior_point_solves,
                      &c.corner_solutions,
                      &c.unsettled_corners})
    visit(*count);
  visit(c.max_penetration);
  visit(c.max_residual);
  visit(c.largest_tolerance);
}

template <class Archive, class SomeEquilibrium>
void visit_equilibrium(Archive& visit, SomeEquilibrium& e) {
  visit(e.unbalanced);
  visit(e.unbalanced_block);
  visit(e.n_unbalanced);
  visit(e.unbalanced_before);
  visit(e.fastest);
  visit(e.fastest_block);
  visit(e.relative_speed);
  visit(e.kinetic);
}

template <class Archive, class Record>
void visit_record(Archive& visit, Record& r) {
  visit(r.step.steps);
  visit(r.step.begun);
  visit(r.step.substep);
  visit(r.step.progress.stage);
  visit(r.step.progress.steps);
  visit.list(r.step.progress.start_times, [&](auto& time) { visit(time); });
  visit(r.step.progress.came_to_rest);
  auto& state = r.step.state;
  visit(state.time);
  visit(state.origin);
  visit(state.position);
  visit(state.velocity);
  visit(state.coordinates);
  visit(state.carried);
  visit(state.carried_dt);
  visit(state.stress);
  visit(state.rotation);
  visit(state.bolts);
  visit(r.step.fading.forces);
  visit(r.step.fading.from);
  visit(r.step.fading.to);
  for (auto* numbers : {&r.step.sleeping.island, &r.step.sleeping.rested})
    visit.list(*numbers, [&](auto& number) { visit(number); });
  visit.list(r.step.sleeping.around, [&](auto& box) {
    visit(box.low);
    visit(box.high);
  });
  visit.list(r.step.contacts, [&](auto& contact) { visit_contact(visit, contact); });
  visit_counts(visit, r.counts);
  EnergyLedger::visit_numbers(r.energy, visit);
  visit(r.last_dt);
  visit(r.end_time);
  visit(r.zero_position);
  visit(r.zero_origin);
  visit(r.reactions);
  visit.list(r.convex, [&](auto& convex) { visit(convex); });
  visit.list(r.notes, [&](auto& note) { visit(note); });
  visit(r.last_unsettled);
  visit_equilibrium(visit, r.equilibrium);
  visit.list(r.stage_ends, [&](auto& end) {
    visit(end.stage);
    visit(end.steps);
    visit(end.time);
    visit(end.came_to_rest);
    visit(end.at_rest);
    visit(end.exchanged);
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
