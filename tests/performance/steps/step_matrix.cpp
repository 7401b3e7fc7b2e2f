#include "step_matrix.hpp"
#include <ddacontact/time/step_from.hpp>
#include <tests/support/block_tangent.hpp>

#include <polyfem/assembly/pattern_matrix.hpp>

namespace step_performance {

using namespace ddacontact;

polyfem::SparseMatrix step_matrix(Stepper& stepper) {
  const BlockSystem& blocks = stepper.blocks();
  polyfem::Connectivity connectivity;
  std::vector<int> active, rows;
  std::vector<const Contact*> closed;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Range& u = blocks.block(b).unknowns();
    active.push_back(b);
    connectivity.append({blocks.equation().data() + u.first, static_cast<std::size_t>(u.count)});
  }
  const std::vector<Contact> contacts = stepper.contacts_to_begin_with();
  for (const Contact& contact : contacts) {
    if (!contact.closed()) continue;
    closed.push_back(&contact);
    rows.clear();
    const AffineForm form = contact.motion.form(contact.first_gap());
    for (const int unknown : form.unknowns()) rows.push_back(blocks.equation()[unknown]);
    connectivity.append(rows);
  }
  polyfem::PatternMatrix matrix;
  matrix.set_connectivity(blocks.n_equations(), connectivity);
  matrix.set_zero();
  int element = 0;
  const AnalysisOptions& analysis = stepper.stages()[stepper.stage()].analysis;
  const StepStart start = step_from(analysis, stepper.state(), analysis.time_step);
  for (const int b : active) {
    std::unique_ptr<BlockStep> step;
    blocks.block(b).begin_step(stepper.state(), start, step);
    const VectorXd at_start = VectorXd::Zero(blocks.block(b).n_unknowns());
    matrix.add(element++, support::tangent_of(blocks.block(b), *step, at_start));
  }
  for (const Contact* contact : closed) {
    matrix.add_outer(element, contact->law.normal_stiffness,
                     contact->motion.form(contact->first_gap()).coefficients());
    if (contact->history.state == ContactState::stick)
      matrix.add_outer(element, contact->law.tangential_stiffness,
                       contact->motion.form(contact->first_slip()).coefficients());
    ++element;
  }
  return matrix.lower();
}

}  // namespace step_performance
