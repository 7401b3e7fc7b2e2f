#include <ddacontact/equations/islands_apart.hpp>

#include <ddacontact/contact/contact_positions.hpp>
#include <ddacontact/core/disjoint_sets.hpp>
#include <ddacontact/core/sort_once.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace ddacontact {

namespace {

/// Adds what the contact's forces do to a block that does not move.
void add_to_prescribed(const Contact& contact, const Range& unknowns, const VectorXd& d,
                       Directions directions, VectorXd& external) {
  const MovingVertexEdge& m = contact.motion;
  const GapAndSlip at_d = m.gap_and_slip_at(d, contact.history.lock, directions);
  for (const auto& [gradient, force] :
       {std::pair{&at_d.by_gap, contact.normal}, std::pair{&at_d.by_slip, contact.shear}}) {
    m.form(*gradient).for_terms([&](int u, double coefficient) {
      if (u >= unknowns.first && u < unknowns.end()) external[u] += force * coefficient;
    });
  }
}

/// Blocks of an island, some perhaps twice, and its contacts.
struct Members {
  std::vector<int> blocks, contacts;
};

/// Those that move by their first blocks, with what they may touch that rests.
std::vector<Members> find_islands(const BlockSystem& blocks, const std::vector<Contact>& contacts) {
  const int n_blocks = blocks.n_blocks();
  DisjointSets islands(n_blocks);
  std::vector<char> meets(n_blocks, 0);
  const auto moves = [&](int b) { return !blocks.is_unchanging(b); };
  // Calls visit(blocks, number of the contact) for what joins blocks; -1: it is a bolt.
  const auto for_links = [&](const auto& visit) {
    for (int c = 0; c < static_cast<int>(contacts.size()); ++c) visit(contacts[c].pair.blocks(), c);
    for (const Bolt& bolt : blocks.bolts) {
      std::vector<int> of_nodes;
      for (const MaterialPoint& node : bolt.nodes)
        if (node.block >= 0) of_nodes.push_back(node.block);
      if (acts(bolt, blocks)) visit(of_nodes, -1);
    }
  };
  for_links([&](const auto& linked, int) {
    const auto first = std::ranges::find_if(linked, moves);
    for (int b : linked) {
      meets[b] = 1;
      if (moves(b)) islands.join(*first, b);
    }
  });
  std::vector<int> numbers(n_blocks + 1, -1);  // of islands by their roots; last of those that meet nothing
  std::vector<Members> members;
  const auto island_of = [&](int b) -> Members& {
    int& number = numbers[meets[b] ? islands.root(b) : n_blocks];
    if (number < 0) {
      number = static_cast<int>(members.size());
      members.emplace_back();
    }
    return members[number];
  };
  for (int b = 0; b < n_blocks; ++b)
    if (moves(b)) island_of(b).blocks.push_back(b);
  for_links([&](const auto& linked, int contact) {
    const auto first = std::ranges::find_if(linked, moves);
    if (first == linked.end()) return;
    Members& island = island_of(*first);
    if (contact >= 0) island.contacts.push_back(contact);
    std::ranges::copy_if(linked, std::back_inserter(island.blocks), std::not_fn(moves));
  });
  return members;
}

/// Forces on blocks at rest, where contacts of several islands act.
void balance_at_rest(const BlockSystem& blocks, const std::vector<Contact>& contacts, const StepSystem& whole,
                     Directions directions, const VectorXd& d, Residual& residual) {
  const VectorXd own = whole.load_forces() + whole.gravity_forces() + whole.bolt_forces(d);
  const auto for_resting = [&](auto&& work) {
    for (const PrescribedDof& prescribed : blocks.prescribed_dofs())
      if (blocks.is_unchanging(blocks.block_of_point(prescribed.vertex))) work(prescribed.unknown);
  };
  for_resting([&](int u) { residual.external[u] = own[u]; });
  for (const Contact& contact : contacts)
    for (int b : contact.pair.blocks())
      if (blocks.is_unchanging(b) && (contact.normal != 0 || contact.shear != 0))
        add_to_prescribed(contact, blocks.block(b).unknowns(), d, directions, residual.external);
  for_resting([&](int u) { residual.force[u] = -residual.external[u]; });
}

}  // namespace

Contact IslandsApart::Island::to_part(Contact contact) const {
  VertexEdge& pair = contact.pair;
  pair.vertex_block = part.number_of(pair.vertex_block);
  pair.edge_block = part.number_of(pair.edge_block);
  set_maps(part.system(), pair, contact.motion);
  return contact;
}

void IslandsApart::Island::add_to(ContactSolverReport& report, const ContactSolverReport& of_own) const {
  report.status = of_own.status;
  report.worst_contact = of_own.worst_contact < 0 ? -1 : contacts[of_own.worst_contact];
  report.iterations = std::max(report.iterations, of_own.iterations);
  report.interior_point_solves += of_own.interior_point_solves;
  report.augmentations = std::max(report.augmentations, of_own.augmentations);
  report.sweeps += of_own.sweeps;
  report.tolerance = std::max(report.tolerance, of_own.tolerance);
  report.interior_solutions += of_own.interior_solutions;
  report.sweep_fallbacks += of_own.sweep_fallbacks;
  Residual& residual = report.residual;
  const Residual& own = of_own.residual;
  residual.force(part.unknowns()) = own.force;
  residual.external(part.unknowns()) = own.external;
  for (double Residual::*measure :
       {&Residual::largest, &Residual::scale, &Residual::round_off, &Residual::over_round_off})
    residual.*measure = std::max(residual.*measure, own.*measure);
  if (!(own.block_relative > residual.block_relative)) return;
  residual.block_relative = own.block_relative;
  residual.worst_block = own.worst_block < 0 ? -1 : part.blocks()[own.worst_block];
}

bool IslandsApart::divide(const BlockSystem& blocks, const std::vector<Contact>& contacts) {
  std::vector<Members> members = find_islands(blocks, contacts);
  if (members.size() < 2) return false;
  std::map<std::vector<int>, std::unique_ptr<Island>> before;
  for (std::unique_ptr<Island>& island : islands_) before.emplace(island->blocks, std::move(island));
  islands_.clear();
  std::vector<char> resting(blocks.n_blocks());
  for (int b = 0; b < blocks.n_blocks(); ++b) resting[b] = blocks.is_unchanging(b);
  for (auto& [of_island, its_contacts] : members) {
    sort_once(of_island);
    const auto same = before.find(of_island);
    islands_.push_back(same != before.end() ? std::move(same->second)
                                            : std::make_unique<Island>(blocks, of_island, resting));
    islands_.back()->contacts = std::move(its_contacts);
  }
  return true;
}

ContactSolverReport IslandsApart::solve(const BlockState& state, const StepStart& start,
                                        const StepSystem& whole, const ContactSolverOptions& options,
                                        std::vector<Contact>& contacts, VectorXd& d) {
  const BlockSystem& blocks = whole.blocks();
  work_ = {};
  ContactSolverReport report;
  report.status = SolutionStatus::settled;
  Residual& residual = report.residual;
  residual.external = whole.load_forces() + whole.gravity_forces();
  residual.force = -residual.external;
  const VectorXd start_d = std::exchange(d, whole.prescribed());
  for (const std::unique_ptr<Island>& island : islands_) {
    BlockSystem::Part& part = island->part;
    const StepStart of_part{start.rule, start.dt, island->of_part(start.velocity),
                            island->of_part(start.acceleration)};
    part.read(blocks, state);
    StepSystem& system = island->system;
    const polyfem::CholeskyWork before = system.problem().cholesky().work();
    system.set_step(part.state(), of_part, whole.fixed_point_stiffness());
    system.problem().keep_factor(options.skip.unchanged_factor);
    std::vector<Contact> own;
    for (int c : island->contacts) own.push_back(island->to_part(contacts[c]));
    VectorXd own_d = island->of_part(start_d);
    const ContactSolverReport of_own = solve_contacts(system, options, own, own_d);
    work_ += system.problem().cholesky().work().since(before);
    for (std::size_t c = 0; c < own.size(); ++c) {
      Contact& contact = contacts[island->contacts[c]];
      own[c].pair = contact.pair;
      own[c].motion = contact.motion;
      contact = std::move(own[c]);
    }
    d(part.unknowns()) = own_d;
    island->add_to(report, of_own);
    if (report.status != SolutionStatus::settled) return report;
  }
  balance_at_rest(blocks, contacts, whole, options.directions, d, residual);
  return report;
}

}  // namespace ddacontact
