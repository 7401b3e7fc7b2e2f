#include <ddacontact/scene/first_loading.hpp>

#include <ddacontact/equations/step_system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

/// The inertia of the softest block over its stiffness: keeps what nothing holds from being singular.
constexpr double inertia_ratio = 1e-6;
/// Displacements are made this small, of the smallest block, where stresses are taken: to first order.
constexpr double small_move = 1e-6;
/// Blocks no further apart than this part of their sizes touch: more than round-off leaves between them, and
/// at least what the contacts at the start are closed by.
constexpr double touching = 1e-6;
/// Of the largest force on a block: more than this is not worth while for a choice.
constexpr double tolerance = 1e-4;

double step_length(const BlockSystem& blocks) {
  double shortest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < blocks.n_blocks(); ++b)
    shortest = std::min(shortest, std::sqrt(2 * blocks.block(b).mass_total() /
                                            (inertia_ratio * blocks.block(b).material().elasticity(2, 2))));
  return shortest;
}

ContactTerm term_of(const Contact& contact) {
  ContactTerm term;
  term.gap = contact.motion.form({0, contact.first_gap().gradient});
  term.slip = contact.motion.form({0, contact.first_slip().gradient});
  term.normal_stiffness = contact.law.normal_stiffness;
  term.tangential_stiffness = contact.law.tangential_stiffness;
  term.normal = contact.history.bonded ? ContactTerm::Normal::unilateral : ContactTerm::Normal::absent;
  term.sheared = !contact.law.frictionless();
  return term;
}

/// Stresses by displacements made small, and made large again.
void add_stresses(const StepSystem& system, const BlockState& initial, const VectorXd& d,
                  FirstLoading& result) {
  const BlockSystem& blocks = system.blocks();
  double smallest = std::numeric_limits<double>::infinity();
  for (int b = 0; b < blocks.n_blocks(); ++b) smallest = std::min(smallest, blocks.block(b).size());
  const double part = std::min(1.0, small_move * smallest / d.lpNorm<Eigen::Infinity>());
  BlockState moved = initial;
  system.end(part * d, VectorXd::Zero(d.size()), moved);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    const Block& block = blocks.block(b);
    const Tensors before = block.stress(initial), stress = before + (block.stress(moved) - before) / part;
    const polyfem::PolygonRule rule{block.integration_points(), block.integration_weights()};
    result.moments.push_back(moments_of_stresses(rule, stress));
    result.mean.emplace_back(stress * rule.weights / rule.weights.sum());
  }
}

/// Displacements, and the residual that reactions are.
struct FirstSolution {
  const StepSystem& system;
  const VectorXd &d, &r;
};

/// What acts on the blocks, each force with its place from the centroid.
void add_forces(const BlockSystem& blocks, const BlockState& initial, const std::vector<Contact>& contacts,
                const std::vector<ContactTerm>& terms, const FirstSolution& solution, FirstLoading& result) {
  const auto add = [&](int block, const Vec2& from_origin, const Vec2& force) {
    result.forces[block].push_back({from_origin - blocks.block(block).moments(initial).centroid, force});
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const ContactForce force = contact_force(terms[c], solution.d);
    if (force.normal == 0 && force.shear == 0) continue;
    const VertexEdgePositions& point = contacts[c].motion.start;
    const Vec2 along = (point.k - point.j).normalized(), out(along.y(), -along.x()),
               on_vertex = force.normal * out + force.shear * along;
    const auto [vertex_block, vertex, edge_block, edge, corner] = contacts[c].pair;
    const Vec2 shift = initial.origin.col(edge_block) - initial.origin.col(vertex_block);
    add(vertex_block, point.i + shift, on_vertex);
    add(edge_block, point.i, -on_vertex);
  }
  for (const PrescribedDof& held : blocks.prescribed_dofs()) {
    const int b = blocks.block_of_point(held.vertex);
    add(b, initial.position.col(held.vertex), solution.r[held.unknown] * Vec2::Unit(held.axis));
  }
  for (const PointLoad& load : blocks.point_loads) {
    const auto points = initial.position.middleCols(blocks.block(load.point.block).points().first,
                                                    blocks.block(load.point.block).n_points());
    add(load.point.block, points * load.point.weights, load.force.at(blocks.end_time, blocks.end_time));
  }
  blocks.add_edge_forces(initial, blocks.end_time, [&](int block, int vertex, const Vec2& force) {
    add(block, initial.position.col(blocks.block(block).vertices().first + vertex), force);
  });
  for (const StepBolt& bolt : solution.system.bolts_at(solution.d))
    for (std::size_t i = 0; i < bolt.bolt().nodes.size(); ++i) {
      const MaterialPoint& node = bolt.bolt().nodes[i];
      if (node.block < 0) continue;  // of a block that was removed
      add(node.block, blocks.interpolate(node, initial.position), bolt.force_on(static_cast<int>(i)));
    }
}

}  // namespace

FirstLoading load_once(BlockSystem& blocks, const BlockState& initial, ContactBuilder& builder) {
  FirstLoading result;
  const auto n_blocks = static_cast<std::size_t>(blocks.n_blocks());
  result.forces.resize(n_blocks);
  blocks.reshape(initial, true);
  std::vector<double> search_margin;
  for (int b = 0; b < blocks.n_blocks(); ++b) search_margin.push_back(touching * blocks.block(b).size());
  const std::vector<Contact> contacts =
      builder.build_first(initial, VectorXd::Zero(blocks.n_unknowns()), search_margin);
  std::vector<ContactTerm> terms;
  for (const Contact& contact : contacts) terms.push_back(term_of(contact));

  StepSystem system(blocks);
  StepStart start;
  start.rule.scheme = Scheme::dda;
  start.dt = step_length(blocks);
  start.velocity = start.acceleration = VectorXd::Zero(blocks.n_unknowns());
  double stiffest = 0;
  for (const Contact& contact : contacts) stiffest = std::max(stiffest, contact.law.normal_stiffness);
  system.set_step(initial, start, stiffest);
  VectorXd d = VectorXd::Zero(blocks.n_unknowns());
  system.linearize(d);
  system.problem().contacts_changed();
  Residual without_contacts;
  system.compute_residual(d, {}, {}, {}, without_contacts);
  const VectorXd& g0 = without_contacts.force;
  const double largest = g0.lpNorm<Eigen::Infinity>();
  for (const bool pressed_alone : {false, true}) {
    for (std::size_t c = 0; c < contacts.size(); ++c)
      terms[c].bound = pressed_alone && contact_force(terms[c], d).normal <= tolerance * largest
                           ? 0
                           : std::numeric_limits<double>::infinity();
    const MinimizeReport report = system.problem().minimize(terms, g0, {.tolerance = tolerance * largest}, d);
    if (report.status != MinimizeStatus::converged || !d.allFinite()) return result;
  }
  result.settled = true;

  VectorXd r;
  system.problem().compute_residual(terms, g0, d, r);
  add_forces(blocks, initial, contacts, terms, {system, d, r}, result);
  add_stresses(system, initial, d, result);
  return result;
}

}  // namespace ddacontact
