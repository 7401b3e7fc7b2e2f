#include <ddacontact/solver/islands_apart.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace ddacontact {

namespace {

int root(std::vector<int>& parent, int k) {
  while (parent[k] != k) k = parent[k] = parent[parent[k]];
  return k;
}

/// Adds what the contact's forces do to a block that does not move.
void add_to_prescribed(const Contact& contact, const Range& unknowns, const VectorXd& d,
                       Directions directions, VectorXd& external) {
  const MovingVertexEdge& m = contact.motion;
  const GapAndSlip at_d = m.gap_and_slip_at(d, contact.history.lock, directions);
  for (const auto& [gradient, force] :
       {std::pair{&at_d.by_gap, contact.normal}, std::pair{&at_d.by_slip, contact.shear}}) {
    const AffineForm form = m.form(*gradient);
    for (std::size_t k = 0; k < form.unknowns().size(); ++k) {
      const int u = form.unknowns()[k];
      if (u >= unknowns.first && u < unknowns.end()) external[u] += force * form.coefficients()[k];
    }
  }
}

}  // namespace

struct IslandsApart::Island {
  std::vector<int> blocks;    ///< and those at rest that they may touch, ascending
  std::vector<int> contacts;  ///< of the step
  std::optional<SystemPart> part;
  std::optional<StepSystem> system;

  /// Of the part's unknowns.
  VectorXd of_part(const VectorXd& of_all) const { return of_all(part->unknowns()); }

  Contact to_part(const BlockSystem& system_of_part, Contact contact) const {
    VertexEdge& pair = contact.pair;
    pair.vertex_block = part->number_of(pair.vertex_block);
    pair.edge_block = part->number_of(pair.edge_block);
    const Block& edge_block = system_of_part.block(pair.edge_block);
    const Block& vertex_block = system_of_part.block(pair.vertex_block);
    contact.motion.i = vertex_block.vertex_map(pair.vertex);
    if (contact.motion.rounding) {
      Rounding rounding = *contact.motion.rounding;
      rounding.of_after_i = vertex_block.vertex_map((pair.vertex + 1) % vertex_block.n_vertices());
      contact.motion.rounding = std::make_shared<const Rounding>(rounding);
    }
    contact.motion.j = edge_block.vertex_map(pair.edge);
    contact.motion.k = edge_block.vertex_map((pair.edge + 1) % edge_block.n_vertices());
    return contact;
  }

  void to_whole(Contact&& solved, Contact& contact) const {
    solved.pair = contact.pair;
    solved.motion = contact.motion;
    contact = std::move(solved);
  }
};

IslandsApart::IslandsApart() = default;
IslandsApart::~IslandsApart() = default;

void IslandsApart::clear() {
  islands_.clear();
}

bool IslandsApart::divide(BlockSystem& blocks, const std::vector<Contact>& contacts) {
  const int n_blocks = blocks.n_blocks();
  std::vector<int> parent(n_blocks);
  std::iota(parent.begin(), parent.end(), 0);
  std::vector<char> meets(n_blocks, 0);
  for (const Contact& contact : contacts) {
    const int a = contact.pair.vertex_block, b = contact.pair.edge_block;
    meets[a] = meets[b] = 1;
    if (!blocks.is_unchanging(a) && !blocks.is_unchanging(b)) parent[root(parent, a)] = root(parent, b);
  }
  for (const Bolt& bolt : blocks.bolts) {
    if (!acts(bolt, blocks)) continue;
    int first = -1;
    for (const MaterialPoint& node : bolt.nodes) {
      if (node.block < 0 || blocks.is_unchanging(node.block)) continue;
      meets[node.block] = 1;
      if (first < 0) first = node.block;
      parent[root(parent, first)] = root(parent, node.block);
    }
  }
  std::vector<int> numbers(n_blocks + 1, -1);  // of islands by their roots; last of those that meet nothing
  std::vector<std::vector<int>> members;
  const auto island_of = [&](int b) {
    int& number = numbers[meets[b] ? root(parent, b) : n_blocks];
    if (number < 0) {
      number = static_cast<int>(members.size());
      members.emplace_back();
    }
    return number;
  };
  for (int b = 0; b < n_blocks; ++b)
    if (!blocks.is_unchanging(b)) members[island_of(b)].push_back(b);
  if (members.size() < 2) return false;

  std::vector<std::vector<int>> of_island(members.size());
  for (int c = 0; c < static_cast<int>(contacts.size()); ++c) {
    const int a = contacts[c].pair.vertex_block, b = contacts[c].pair.edge_block;
    const int island = island_of(blocks.is_unchanging(a) ? b : a);
    of_island[island].push_back(c);
    for (int at_rest : {a, b})
      if (blocks.is_unchanging(at_rest)) members[island].push_back(at_rest);
  }
  for (const Bolt& bolt : blocks.bolts)
    if (acts(bolt, blocks)) {
      int island = -1;
      for (const MaterialPoint& node : bolt.nodes)
        if (node.block >= 0 && !blocks.is_unchanging(node.block)) island = island_of(node.block);
      for (const MaterialPoint& node : bolt.nodes)
        if (node.block >= 0 && blocks.is_unchanging(node.block)) members[island].push_back(node.block);
    }
  std::map<std::vector<int>, std::unique_ptr<Island>> before;
  for (std::unique_ptr<Island>& island : islands_) before.emplace(island->blocks, std::move(island));
  islands_.clear();
  std::vector<char> resting(n_blocks);
  for (int b = 0; b < n_blocks; ++b) resting[b] = blocks.is_unchanging(b);
  for (std::size_t k = 0; k < members.size(); ++k) {
    std::ranges::sort(members[k]);
    members[k].erase(std::unique(members[k].begin(), members[k].end()), members[k].end());
    if (const auto same = before.find(members[k]); same != before.end()) {
      islands_.push_back(std::move(same->second));
    } else {
      islands_.push_back(std::make_unique<Island>());
      islands_.back()->blocks = members[k];
      islands_.back()->part.emplace(blocks, members[k], resting);
    }
    islands_.back()->contacts = std::move(of_island[k]);
  }
  return true;
}

ContactSolverReport IslandsApart::solve(BlockSystem& blocks, BlockState& state, const StepStart& start,
                                        const StepSystem& whole, const ContactSolverOptions& options,
                                        std::vector<Contact>& contacts, VectorXd& d) {
  work_ = {};
  ContactSolverReport report;
  report.status = ContactSolverStatus::settled;
  Residual& residual = report.residual;
  residual.external = whole.load_forces() + whole.gravity_forces();
  residual.force = -residual.external;
  const VectorXd start_d = std::exchange(d, whole.prescribed());
  for (const std::unique_ptr<Island>& island : islands_) {
    SystemPart& part = *island->part;
    StepStart of_part{start.rule, start.dt, island->of_part(start.velocity),
                      island->of_part(start.acceleration)};
    part.put_in(blocks, state);
    if (!island->system) island->system.emplace(blocks);
    StepSystem& system = *island->system;
    const polyfem::CholeskyWork before = system.problem().cholesky().work();
    system.set_step(state, of_part, whole.fixed_point_stiffness());
    system.problem().keep_factor(options.skip.unchanged_factor);
    std::vector<Contact> own;
    for (int c : island->contacts) own.push_back(island->to_part(blocks, contacts[c]));
    VectorXd own_d = island->of_part(start_d);
    ContactSolverReport own_report = solve_contacts(system, options, own, own_d);
    part.take_out(blocks, state);
    work_ += system.problem().cholesky().work().since(before);
    for (std::size_t c = 0; c < own.size(); ++c)
      island->to_whole(std::move(own[c]), contacts[island->contacts[c]]);
    const Residual& of_own = own_report.residual;
    d(part.unknowns()) = own_d;
    residual.force(part.unknowns()) = of_own.force;
    residual.external(part.unknowns()) = of_own.external;
    report.iterations = std::max(report.iterations, own_report.iterations);
    report.interior_point_solves += own_report.interior_point_solves;
    report.augmentations = std::max(report.augmentations, own_report.augmentations);
    report.sweeps += own_report.sweeps;
    report.tolerance = std::max(report.tolerance, own_report.tolerance);
    report.interior_solutions += own_report.interior_solutions;
    report.tangent += own_report.tangent;
    for (double Residual::*measure :
         {&Residual::largest, &Residual::scale, &Residual::round_off, &Residual::over_round_off})
      residual.*measure = std::max(residual.*measure, of_own.*measure);
    if (of_own.block_relative > residual.block_relative) {
      residual.block_relative = of_own.block_relative;
      residual.worst_block = of_own.worst_block < 0 ? -1 : part.blocks()[of_own.worst_block];
    }
    if (own_report.status == ContactSolverStatus::settled) continue;
    report.status = own_report.status;
    report.worst_contact = own_report.worst_contact < 0 ? -1 : island->contacts[own_report.worst_contact];
    return report;
  }

  // On blocks at rest contacts of several islands act.
  for (const PrescribedDof& prescribed : blocks.prescribed_dofs())
    residual.external[prescribed.unknown] =
        blocks.is_unchanging(blocks.block_of_point(prescribed.vertex))
            ? whole.load_forces()[prescribed.unknown] + whole.gravity_forces()[prescribed.unknown]
            : residual.external[prescribed.unknown];
  const VectorXd of_bolts = whole.bolt_forces(d);
  for (const PrescribedDof& prescribed : blocks.prescribed_dofs())
    if (blocks.is_unchanging(blocks.block_of_point(prescribed.vertex)))
      residual.external[prescribed.unknown] += of_bolts[prescribed.unknown];
  for (const Contact& contact : contacts)
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block})
      if (blocks.is_unchanging(b) && (contact.normal != 0 || contact.shear != 0))
        add_to_prescribed(contact, blocks.block(b).unknowns(), d, options.directions, residual.external);
  for (const PrescribedDof& prescribed : blocks.prescribed_dofs())
    if (blocks.is_unchanging(blocks.block_of_point(prescribed.vertex)))
      residual.force[prescribed.unknown] = -residual.external[prescribed.unknown];
  return report;
}

}  // namespace ddacontact
