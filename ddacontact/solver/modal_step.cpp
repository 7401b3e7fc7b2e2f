#include <ddacontact/solver/modal_step.hpp>

#include <ddacontact/block/corotational_motion.hpp>
#include <ddacontact/block/for_blocks.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <array>
#include <optional>
#include <span>
#include <utility>

namespace ddacontact {

namespace {

/// Gaps of closed contacts smaller than this, of the block size, are left as they are: what is not moved needs no
/// impulse. Ten joints of a column of rock then hide 1e-4 of its settlement.
constexpr double gap_left = 1e-9;
/// A step is solved so often for its geometry at the end.
constexpr int most_geometry_rounds = 12;
/// Bonds that exceed their strength by this part of the worst excess break together.
constexpr double breaking_part = 0.5;

using AnyNodes = NodalKinematics<polyfem::AnyNodes>;

VectorXd unknowns_of(const CorotationalShape& shape, const Points& of_nodes) {
  VectorXd of_unknowns(shape.n_unknowns());
  AnyNodes(shape).to_unknowns(of_nodes, of_unknowns);
  return of_unknowns;
}

/// A block in a step: where it is, how it would go on, and how it resists.
struct Motion {
  int block = -1;
  Range unknowns;
  const CorotationalShape* shape = nullptr;
  const ModalShape* modal = nullptr;
  VectorXd start;         ///< coordinates at the start
  VectorXd before;        ///< s of the step before
  VectorXd free;          ///< s without contacts and supports
  VectorXd mass;          ///< the diagonal of A
  VectorXd inertia;       ///< that of it which is inertia
  VectorXd load;          ///< generalized forces of weight and loads
  VectorXd initial;       ///< of the stress at rest; empty: none
  VectorXd centrifugal;   ///< of the deformations
  Mat2 turn = Mat2::Identity();
  Points arms;            ///< of the places from the centre of mass, 2 x p
  // With prescribed displacements only:
  std::vector<int> free_unknowns, held_unknowns;  ///< of the block's own
  std::vector<int> held;                          ///< numbers among all held unknowns
  MatrixXd to_unknowns, to_modal;                 ///< velocities of unknowns by s, and back
  MatrixXd unknown_mass;                          ///< A by unknowns
  int body = -1;                                  ///< in the contact problem; -1: nothing of it is free

  bool is_free() const { return held.empty(); }
  Index n() const { return unknowns.count; }
};

class Step {
 public:
  Step(const BlockSystem& blocks, const BlockState& state, const ModalStepRule& rule,
       std::vector<Contact>& contacts)
      : blocks_(blocks),
        state_(state),
        rule_(rule),
        contacts_(contacts),
        motion_of_(static_cast<std::size_t>(blocks.n_blocks()), -1) {
    find_motions();
  }

  ModalSolution solve(bool warm) {
    begin_contacts(warm);
    while (true) {
      solve_geometry();
      const bool solved = solution_.status == ModalStepStatus::solved;
      // Where no motion holds the bonds, and where there is no time between one and the next, they break within.
      if (!(solved && open_bonds_without_tension()) && !((!solved || rule_.is_static) && break_bonds())) break;
      for (std::size_t c = 0; c < contacts_.size(); ++c) bonded_[c] = bonded_[c] && contacts_[c].has_bond();
    }
    finish();
    return std::move(solution_);
  }

 private:
  double dt() const { return rule_.dt; }
  double h() const { return rule_.impulse_time; }

  // ---- blocks

  void find_motions() {
    for (int b = 0; b < blocks_.n_blocks(); ++b) {
      if (blocks_.is_unchanging(b)) continue;
      motion_of_[b] = static_cast<int>(motions_.size());
      motions_.emplace_back();
      motions_.back().block = b;
    }
    Points forces = Points::Zero(2, state_.position.cols());
    Points weights = Points::Zero(2, blocks_.n_blocks());
    blocks_.add_loads(state_, state_.time, forces, weights);
    for (std::size_t k = 0; k < blocks_.held_unknowns().size(); ++k) {
      const HeldUnknown& held = blocks_.held_unknowns()[k];
      const int motion = motion_of_[blocks_.block_of_unknown(held.unknown)];
      if (motion >= 0) motions_[motion].held.push_back(static_cast<int>(k));
    }
    prescribed_ = blocks_.held_unknowns().empty() ? VectorXd()
                                                  : blocks_.prescribed(state_, state_.time + dt());
    for_blocks(static_cast<int>(motions_.size()),
               [&](int m) { begin(motions_[m], forces, weights.col(motions_[m].block)); });
  }

  void begin(Motion& of, const Points& forces, const Vec2& body_force) const {
    const Block& block = blocks_.block(of.block);
    of.unknowns = block.unknowns();
    of.shape = block.shape();
    const ModalShape& modal = of.shape->modal();
    of.modal = &modal;
    const Index k = modal.n_deformations();
    of.start = state_.modal.segment(of.unknowns.first, of.unknowns.count);
    of.turn = turned_by(of.start[2]);
    const Points Z = modal.deformed(of.start);
    of.arms = of.turn * modal.deformed_places(of.start);
    of.before = VectorXd::Zero(of.n());
    if (!rule_.is_static)
      of.before = modal.velocities_of(
          of.start, AnyNodes(*of.shape).to_nodes(state_.going_on().segment(of.unknowns.first, of.n())));

    of.inertia = VectorXd::Ones(of.n());
    of.inertia.head<2>().setConstant(modal.mass);
    of.inertia[2] = modal.inertia(Z);
    of.load = VectorXd::Zero(of.n());
    of.load.head<2>() = modal.mass * blocks_.gravity + body_force;
    add_forces_at_places(of, forces.middleCols(block.places().first, block.places().count), of.load);
    of.initial = block.initial_modal_force(state_);
    of.centrifugal = of.before[2] * of.before[2] * modal.centrifugal(Z);

    const auto q = of.start.tail(k);
    VectorXd impulse = h() * of.load;
    impulse.tail(k) += h() * (of.centrifugal - modal.stiffness.cwiseProduct(q));
    if (of.initial.size() > 0) impulse.tail(k) -= h() * of.initial;
    of.mass = (1 + h() * rule_.damping.mass) * of.inertia;
    of.mass.tail(k) += h() * (dt() + rule_.damping.stiffness) * modal.stiffness;
    of.free = (of.inertia.cwiseProduct(of.before) + impulse).cwiseQuotient(of.mass);
    if (!of.is_free()) begin_supports(of);
  }

  /// load += what forces at the places (2 x p) are on the block's motions.
  void add_forces_at_places(const Motion& of, const PointsRef& at, VectorXd& load) const {
    if (at.isZero(0)) return;
    load.head<2>() += at.rowwise().sum();
    for (Index p = 0; p < at.cols(); ++p) load[2] += cross(of.arms.col(p), at.col(p));
    load.tail(of.modal->n_deformations()) +=
        of.modal->place_deformations.transpose() * (of.turn.transpose() * at).reshaped();
  }

  void begin_supports(Motion& of) const {
    const Index n = of.n();
    std::vector<char> is_held(static_cast<std::size_t>(n), 0);
    for (int k : of.held) {
      of.held_unknowns.push_back(blocks_.held_unknowns()[k].unknown - of.unknowns.first);
      is_held[of.held_unknowns.back()] = 1;
    }
    for (int u = 0; u < n; ++u)
      if (!is_held[u]) of.free_unknowns.push_back(u);
    of.to_unknowns.resize(n, n);
    for (Index k = 0; k < n; ++k)
      of.to_unknowns.col(k) = unknowns_of(*of.shape, of.modal->node_velocities(of.start, VectorXd::Unit(n, k)));
    of.to_modal = of.to_unknowns.partialPivLu().inverse();
    of.unknown_mass = of.to_modal.transpose() * of.mass.asDiagonal() * of.to_modal;
  }

  /// s of the step when these are the velocities of the unknowns that are free.
  VectorXd modal_of(const Motion& of, const VectorXd& z) const {
    if (of.is_free()) return z;
    VectorXd v = held_velocities(of);
    v(of.free_unknowns) = z;
    return of.to_modal * v;
  }

  /// The prescribed velocities of a block's unknowns, 0 for the free ones.
  VectorXd held_velocities(const Motion& of) const {
    VectorXd v = VectorXd::Zero(of.n());
    for (std::size_t k = 0; k < of.held.size(); ++k)
      v[of.held_unknowns[k]] =
          prescribed_[of.unknowns.first + of.held_unknowns[k]] / dt() - missed_[of.held[k]] / dt();
    return v;
  }

  /// Adds the blocks to a new problem.
  void add_bodies() {
    problem_.emplace();
    for (Motion& of : motions_) {
      const double scale = h() * of.load.head<2>().norm() +
                           of.modal->mass * (of.free - of.before).head<2>().norm();
      if (of.is_free()) {
        of.body = problem_->add_body(of.mass, of.free);
      } else if (!of.free_unknowns.empty()) {
        const VectorXd free = of.to_unknowns * of.free, off = held_velocities(of) - free;
        const MatrixXd A = of.unknown_mass(of.free_unknowns, of.free_unknowns);
        const VectorXd by_supports = of.unknown_mass(of.free_unknowns, of.held_unknowns) * off(of.held_unknowns);
        of.body = problem_->add_body(A, VectorXd(free(of.free_unknowns) - A.llt().solve(by_supports)));
      }
      if (of.body >= 0) problem_->body_scale.push_back(scale);
    }
  }

  // ---- contacts

  void begin_contacts(bool warm) {
    const std::size_t n = contacts_.size();
    taking_part_.assign(n, 0);
    bonded_.resize(n);
    number_.assign(n, -1);
    geometry_.assign(n, {});
    impulse_.assign(n, {});
    missed_ = VectorXd::Zero(static_cast<Index>(blocks_.held_unknowns().size()));
    straight_.resize(n);
    for (std::size_t c = 0; c < n; ++c) {
      Contact& contact = contacts_[c];
      const ContactHistory& history = contact.history;
      straight_[c] = contact.motion.rates_at(contact.motion.places(), history.lock);
      contact.was_closed = contact.closed();
      bonded_[c] = contact.has_bond();
      taking_part_[c] = bonded_[c] || contact.closed() || contact.is_on_edge(straight_[c].slip);
      if (warm)
        impulse_[c] = {h() * contact.normal, h() * contact.shear};
      else if (contact.closed())
        impulse_[c] = {h() * history.normal, h() * history.shear};
    }
  }

  /// A joint with a dashpot is a spring beside it, N = -k g - c g', g that at the end of the step.
  bool has_spring(std::size_t c) const { return contacts_[c].damping > 0 && !bonded_[c]; }
  /// k dt + c, N s/m per m.
  double spring_rate(std::size_t c) const {
    return dt() * (contacts_[c].law.normal_stiffness + contacts_[c].damping);
  }

  double gap(std::size_t c) const { return straight_[c].gap - contacts_[c].history.gap_offset; }

  /// b_n without what the straight motion misses: rates that close a gap, leave it, or push penetration out.
  double normal_offset(std::size_t c) const {
    if (has_spring(c)) return gap(c) * contacts_[c].law.normal_stiffness / spring_rate(c);
    const double left = gap_left * contacts_[c].size, g = gap(c);
    return g > left ? g / dt() : g < -left ? (g + left) / dt() : 0;
  }

  /// What the velocities of a block's free unknowns make of the rate that belongs to these forces at places.
  VectorXd row(const Motion& of, std::span<const std::pair<int, Vec2>> at, double& by_supports) const {
    if (of.is_free()) {
      VectorXd row = VectorXd::Zero(of.n());
      for (const auto& [place, g] : at) {
        row.head<2>() += g;
        row[2] += cross(of.arms.col(place), g);
        row.tail(of.modal->n_deformations()) +=
            of.modal->place_deformations.middleRows<2>(2 * place).transpose() * (of.turn.transpose() * g);
      }
      return row;
    }
    VectorXd own = VectorXd::Zero(of.n());
    for (const auto& [place, g] : at)
      blocks_.block(of.block).vertex_map(place).add_force(g, of.unknowns.first, own);
    by_supports += own.dot(held_velocities(of));
    return own(of.free_unknowns);
  }

  struct Rows {
    int body = -1;
    VectorXd normal, shear;
  };
  /// Those of one side of a contact; \param[out] offset  rates that prescribed motion makes
  Rows rows(std::size_t c, bool of_vertex, NormalAndShear& offset) const {
    const Contact& contact = contacts_[c];
    const VertexEdge& pair = contact.pair;
    const int block = of_vertex ? pair.vertex_block : pair.edge_block;
    if (motion_of_[block] < 0) return {};
    const Motion& of = motions_[motion_of_[block]];
    const int n_vertices = blocks_.block(block).n_vertices();
    const auto at = [&](const VertexEdgeGradient& g) {
      std::array<std::pair<int, Vec2>, 2> forces;
      if (of_vertex)
        forces = {{{pair.vertex, g.i}, {(pair.vertex + 1) % n_vertices, g.after_i}}};
      else
        forces = {{{pair.edge, g.j}, {(pair.edge + 1) % n_vertices, g.k}}};
      return forces;
    };
    const auto normal = at(straight_[c].by_gap), shear = at(straight_[c].by_slip);
    Rows rows{of.body, row(of, normal, offset.normal), row(of, shear, offset.shear)};
    return rows;
  }

  CoulombLaw law(std::size_t c) const {
    const JointLaw& joint = contacts_[c].law;
    CoulombLaw law;
    law.friction = joint.friction;
    law.friction_law = joint.friction_law;
    law.time = h();
    law.bonded = bonded_[c];
    if (has_spring(c)) law.normal_compliance = 1 / (h() * spring_rate(c));
    return law;
  }

  /// Builds the problem from those that take part, with the geometry known so far.
  void build_problem() {
    add_bodies();
    prescribed_rate_.assign(contacts_.size(), {});
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      number_[c] = -1;
      if (!taking_part_[c]) continue;
      NormalAndShear& rate = prescribed_rate_[c];
      const Rows vertex = rows(c, true, rate), edge = rows(c, false, rate);
      if (vertex.body < 0 && edge.body < 0) continue;
      number_[c] = problem_->add_contact({vertex.body, vertex.normal, vertex.shear},
                                         {edge.body, edge.normal, edge.shear}, {}, law(c));
      problem_->impulses[number_[c]] = impulse_[c];
    }
    set_offsets();
  }

  void set_offsets() {
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (number_[c] >= 0)
        problem_->offsets[number_[c]] = {
            normal_offset(c) + prescribed_rate_[c].normal + geometry_[c].normal,
            prescribed_rate_[c].shear + geometry_[c].shear};
  }

  // ---- solution

  void solve_geometry() {
    build_problem();
    for (int round = 1;; ++round) {
      const ContactSolution found =
          ddacontact::solve(*problem_, {.tolerance = rule_.residual_tolerance});
      add(found.counts);
      solution_.geometry_rounds = round;
      solution_.relative_residual = found.residual.relative;
      take(found.velocity);
      if (!solution_.displacement.allFinite()) {
        solution_.status = ModalStepStatus::not_finite;
        return;
      }
      if (!found.solved) {
        solution_.status = ModalStepStatus::no_balance;
        for (std::size_t c = 0; c < contacts_.size(); ++c)
          if (found.residual.contact >= 0 && number_[c] == found.residual.contact)
            solution_.worst_contact = static_cast<int>(c);
        return;
      }
      const bool supports_moved = measure_supports();
      const bool others = measure_contacts();
      if (!supports_moved && !others && solution_.worst_contact < 0) {
        solution_.status = ModalStepStatus::solved;
        return;
      }
      if (round == most_geometry_rounds) {
        solution_.status = solution_.worst_contact < 0 ? ModalStepStatus::solved : ModalStepStatus::penetrating;
        return;
      }
      if (supports_moved || others)
        build_problem();
      else
        set_offsets();
    }
  }

  void add(const ContactSolverCounts& counts) {
    solution_.counts.sweeps += counts.sweeps;
    solution_.counts.newton_iterations += counts.newton_iterations;
    solution_.counts.factorizations += counts.factorizations;
    solution_.counts.interior_point_solves += counts.interior_point_solves;
    solution_.counts.interior_point_iterations += counts.interior_point_iterations;
  }

  /// Velocities and displacements of all unknowns.
  void take(const VectorXd& z) {
    z_ = z;
    const Index n = blocks_.n_unknowns();
    solution_.modal_velocity.setZero(n);
    solution_.displacement.setZero(n);
    for_blocks(static_cast<int>(motions_.size()), [&](int m) {
      const Motion& of = motions_[m];
      const VectorXd own = of.body < 0 ? VectorXd() : VectorXd(z.segment(problem_->first(of.body), problem_->count(of.body)));
      const VectorXd s = modal_of(of, own);
      solution_.modal_velocity.segment(of.unknowns.first, of.n()) = s;
      solution_.displacement.segment(of.unknowns.first, of.n()) =
          unknowns_of(*of.shape, of.modal->node_displacements(of.start, dt() * s));
    });
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (number_[c] >= 0) impulse_[c] = problem_->impulses[number_[c]];
      else impulse_[c] = {};
  }

  /// Whether supports have not come to where they should be.
  bool measure_supports() {
    bool moved = false;
    for (const Motion& of : motions_)
      for (std::size_t k = 0; k < of.held.size(); ++k) {
        const int u = of.unknowns.first + of.held_unknowns[k];
        const double error = solution_.displacement[u] - prescribed_[u],
                     tolerance = held_tolerance * blocks_.block(of.block).size();
        if (std::abs(error) <= tolerance) continue;
        missed_[of.held[k]] += error;
        moved = true;
      }
    return moved;
  }
  /// Prescribed places are where they should be to this part of the block size.
  static constexpr double held_tolerance = 1e-14;

  /// Looks at the geometry at the end: what the straight motion misses, who takes part, and which contact is
  /// furthest from its tolerance. Whether others take part than did.
  bool measure_contacts() {
    bool others = false;
    double worst = 1;
    solution_.worst_contact = -1;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      Contact& contact = contacts_[c];
      const GapAndSlip end =
          contact.motion.gap_and_slip_at(solution_.displacement, contact.history.lock, Directions::of_end);
      contact.gap = end.gap;
      contact.end_slip = end.slip;
      const double offset = contact.history.gap_offset, tolerance = rule_.gap_tolerance * contact.size;
      if (number_[c] < 0) {
        const bool enters = end.gap - offset < -tolerance && contact.is_on_edge(end.slip);
        const bool moves = motion_of_[contact.pair.vertex_block] >= 0 || motion_of_[contact.pair.edge_block] >= 0;
        if (enters && moves && !taking_part_[c]) {
          taking_part_[c] = 1;
          others = true;
        }
        continue;
      }
      const NormalAndShear u = problem_->rates(number_[c], z_);
      // The rates without what was missed before.
      const NormalAndShear straight{u.normal - normal_offset(c) - geometry_[c].normal,
                                    u.shear - geometry_[c].shear};
      const double aim = straight_[c].gap - normal_offset(c) * dt();  // the gap that a pressed contact ends with
      const NormalAndShear missed{(end.gap - straight_[c].gap) / dt() - straight.normal,
                                  (end.slip - straight_[c].slip) / dt() - straight.shear};
      const bool presses = impulse_[c].normal != 0 || bonded_[c];
      if (has_spring(c)) {
        geometry_[c].normal = presses ? missed.normal : 0;
        continue;
      }
      const double gap_error = presses ? std::abs(end.gap - aim) : std::max(0.0, aim - end.gap),
                   slip_error = std::abs(missed.shear - geometry_[c].shear) * dt();
      geometry_[c].normal = presses || end.gap < aim ? missed.normal : geometry_[c].normal;
      geometry_[c].shear = presses ? missed.shear : 0;
      const double limit = end_tolerance * contact.size;
      const bool sticks = impulse_[c].shear != 0 || bonded_[c];
      const double error = std::max(gap_error, presses && sticks ? slip_error : 0.0) / limit;
      if (error > worst) {
        worst = error;
        solution_.worst_contact = static_cast<int>(c);
      }
    }
    return others;
  }
  /// Gaps and slips at the end are what they should be to this part of the block size.
  static constexpr double end_tolerance = 1e-9;

  // ---- what comes of it

  double excess_of_bond(std::size_t c) const {
    if (!bonded_[c]) return 0;
    const JointLaw& joint = contacts_[c].law;
    const double normal = impulse_[c].normal / h(), shear = impulse_[c].shear / h(),
                 strength = joint.tension + joint.cohesion + joint.friction * std::max(0.0, normal),
                 excess = std::max(-normal - joint.tension, std::abs(shear) - shear_bound(joint, normal, true));
    return excess > rule_.residual_tolerance * strength ? excess : 0;
  }

  /// Breaks the bonds that bear more than their strength, the worst first; false: none does.
  bool break_bonds() {
    std::vector<double> excess(contacts_.size());
    for (std::size_t c = 0; c < contacts_.size(); ++c) excess[c] = excess_of_bond(c);
    const double worst = excess.empty() ? 0 : *std::max_element(excess.begin(), excess.end());
    if (worst == 0) return false;
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (excess[c] >= breaking_part * worst) contacts_[c].history.bonded = false;
    return true;
  }

  /// Bonds that bear shear alone open where they are pulled; false: none is.
  bool open_bonds_without_tension() {
    bool opened = false;
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (!bonded_[c] || contacts_[c].law.tension > 0 || impulse_[c].normal >= 0) continue;
      contacts_[c].history.bonded = false;
      opened = true;
    }
    return opened;
  }

  void finish() {
    settle_contacts();
    if (solution_.status == ModalStepStatus::solved && !rule_.is_static) break_bonds();
    solution_.reaction = VectorXd::Zero(static_cast<Index>(blocks_.held_unknowns().size()));
    solution_.velocity = VectorXd::Zero(blocks_.n_unknowns());
    solution_.forces.assign(static_cast<std::size_t>(blocks_.n_blocks()), {});
    find_external();
    for (std::size_t k = 0; k < blocks_.held_unknowns().size(); ++k)  // of blocks that stay where they are
      solution_.reaction[static_cast<Index>(k)] = -external_[blocks_.held_unknowns()[k].unknown];
    for (const Motion& of : motions_) finish(of);
    for (std::size_t c = 0; c < contacts_.size(); ++c) account_contact(c);
    std::vector<double> sums(static_cast<std::size_t>(blocks_.n_blocks()), 0);
    for (const Contact& contact : contacts_)
      for (int b : {contact.pair.vertex_block, contact.pair.edge_block})
        sums[b] += std::hypot(contact.normal, contact.shear);
    for (std::size_t b = 0; b < sums.size(); ++b)
      solution_.force_scale = std::max(solution_.force_scale, sums[b] + solution_.forces[b].largest);
  }

  void settle_contacts() {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      Contact& contact = contacts_[c];
      const auto [p, q] = impulse_[c];
      const bool closed = p > 0 || (bonded_[c] && number_[c] >= 0);
      ContactState& to = contact.history.state;
      if (!closed)
        to = ContactState::open;
      else if (!contact.law.has_friction() && !bonded_[c])
        to = ContactState::slip_forward;
      else if (!bonded_[c] && std::abs(q) >= (1 - rule_.residual_tolerance) * law(c).bound(p))
        to = q < 0 ? ContactState::slip_forward : ContactState::slip_backward;
      else
        to = ContactState::stick;
      contact.was_closed = contact.was_closed || closed;
      contact.normal = p / h();
      contact.shear = q / h();
      const bool has_rates = number_[c] >= 0 && solution_.displacement.size() > 0;
      const NormalAndShear u = has_rates ? problem_->rates(number_[c], z_) : NormalAndShear{};
      contact.gap_change = has_rates ? dt() * (u.normal - normal_offset(c) - geometry_used(c).normal) : 0;
      contact.slip_change = has_rates ? dt() * (u.shear - geometry_used(c).shear) : 0;
    }
  }
  /// What the solved problem had for it.
  NormalAndShear geometry_used(std::size_t c) const {
    return {problem_->offsets[number_[c]].normal - normal_offset(c) - prescribed_rate_[c].normal,
            problem_->offsets[number_[c]].shear - prescribed_rate_[c].shear};
  }

  /// Forces of contacts, weight and loads on all unknowns, where a support asks for them.
  void find_external() {
    if (blocks_.held_unknowns().empty()) return;
    external_ = VectorXd::Zero(blocks_.n_unknowns());
    blocks_.add_gravity(external_);
    blocks_.add_loads(state_, state_.time, external_);
    contact_forces_ = VectorXd::Zero(blocks_.n_unknowns());
    for (const Contact& contact : contacts_) {
      if (contact.normal == 0 && contact.shear == 0) continue;
      const GapAndSlip& at_start = straight_[&contact - contacts_.data()];
      contact.motion.form(at_start.by_gap).add_gradient(contact.normal, contact_forces_);
      contact.motion.form(at_start.by_slip).add_gradient(contact.shear, contact_forces_);
    }
    external_ += contact_forces_;
  }

  /// Reactions, balance and work of a block.
  void finish(const Motion& of) {
    const ModalShape& modal = *of.modal;
    const Index k = modal.n_deformations();
    const VectorXd s = solution_.modal_velocity.segment(of.unknowns.first, of.n()), change = s - of.before;
    solution_.velocity.segment(of.unknowns.first, of.n()) =
        unknowns_of(*of.shape, modal.node_velocities(of.start, s));
    BlockForceSum& sum = solution_.forces[of.block];
    const double size = blocks_.block(of.block).size();
    sum.largest = std::max((modal.mass * blocks_.gravity).norm(),
                           std::max((of.load.head<2>() - modal.mass * blocks_.gravity).norm(),
                                    std::abs(of.load[2]) / size));
    sum.resultant = std::max(modal.mass * change.head<2>().norm(), of.inertia[2] * std::abs(change[2]) / size) / h();

    StepWork& work = solution_.work;
    if (!of.is_free()) {
      const VectorXd on_unknowns = of.to_modal.transpose() * of.mass.cwiseProduct(s - of.free) / h() -
                                   contact_forces_.segment(of.unknowns.first, of.n());
      Points at = Points::Zero(2, blocks_.block(of.block).n_places());
      for (std::size_t r = 0; r < of.held.size(); ++r) {
        const double reaction = on_unknowns[of.held_unknowns[r]];
        solution_.reaction[of.held[r]] = reaction;
        const HeldUnknown& held = blocks_.held_unknowns()[of.held[r]];
        at(held.axis, held.vertex - blocks_.block(of.block).places().first) += reaction;
        // A support works on what it prescribes; the straight motion of the start turns away from that.
        work.external += reaction * prescribed_[held.unknown];
        work.scheme -= reaction * (dt() * solution_.velocity[held.unknown] - prescribed_[held.unknown]);
      }
      sum.largest = std::max(sum.largest, at.colwise().norm().maxCoeff());
    }
    work.gravity -= dt() * modal.mass * blocks_.gravity.dot(s.head<2>());
    work.external += dt() * (of.load.dot(s) - modal.mass * blocks_.gravity.dot(s.head<2>()));
    const auto rates = s.tail(k);
    work.damping += dt() * (rule_.damping.mass * of.inertia.dot(s.cwiseAbs2()) +
                            rule_.damping.stiffness * modal.stiffness.dot(rates.cwiseAbs2()));
    work.scheme += dt() * dt() / 2 * modal.stiffness.dot(rates.cwiseAbs2()) +
                   dt() / h() * s.dot(of.inertia.cwiseProduct(change)) - dt() * rates.dot(of.centrifugal);
  }

  /// What a contact takes or gives: friction, the end of an approach, and pushing out.
  void account_contact(std::size_t c) {
    const Contact& contact = contacts_[c];
    if (number_[c] < 0 || (contact.normal == 0 && contact.shear == 0)) return;
    StepWork& work = solution_.work;
    const double by_shear = -contact.shear * contact.slip_change, by_normal = -contact.normal * contact.gap_change;
    // Friction is against the slip at the end; the straight motion of the start misses a part of it.
    const double slipped = bonded_[c] ? 0 : -contact.shear * dt() * problem_->rates(number_[c], z_).shear;
    work.friction += slipped;
    work.scheme += by_shear - slipped;
    if (has_spring(c)) {
      const double by_dashpot = contact.damping * contact.gap_change * contact.gap_change;
      work.damping += by_dashpot;
      work.scheme += by_normal - by_dashpot;  // less what the spring stores
      return;
    }
    // An impulse changes kinetic energy by p times the mean of the rates before and after.
    const double energy = contact.normal * h() * (rate_before(c) + contact.gap_change / dt()) / 2;
    if (energy > 0)
      work.pushed_out += energy;
    else
      work.damping -= energy;
    work.scheme += by_normal + energy;
  }

  /// The rate of the gap by the velocities of the step before.
  double rate_before(std::size_t c) const {
    if (rule_.is_static) return 0;
    return contacts_[c].motion.change_along(straight_[c].by_gap, state_.going_on());
  }

  const BlockSystem& blocks_;
  const BlockState& state_;
  const ModalStepRule& rule_;
  std::vector<Contact>& contacts_;
  std::vector<Motion> motions_;
  std::vector<int> motion_of_;  ///< of each block; -1: it stays where it is
  VectorXd prescribed_;         ///< displacements of held unknowns in the step
  VectorXd missed_;             ///< of each held unknown, what the straight motion misses, m
  std::optional<ContactProblem> problem_;
  std::vector<int> number_;             ///< of each contact in the problem; -1: it takes no part
  std::vector<char> taking_part_, bonded_;
  std::vector<GapAndSlip> straight_;    ///< at the start, with derivatives
  std::vector<NormalAndShear> geometry_, impulse_, prescribed_rate_;
  VectorXd z_;
  VectorXd external_, contact_forces_;  ///< of all unknowns, N per m; without supports empty
  ModalSolution solution_;
};

}  // namespace

ModalSolution ModalStep::solve(const BlockState& state, const ModalStepRule& rule,
                               std::vector<Contact>& contacts, bool warm) {
  return Step(blocks_, state, rule, contacts).solve(warm);
}

void ModalStep::advance(const BlockSystem& blocks, const ModalStepRule& rule, const VectorXd& modal_velocity,
                        BlockState& next) {
  for_blocks(blocks.n_blocks(), [&](int b) {
    if (blocks.is_unchanging(b)) return;
    const Block& block = blocks.block(b);
    const CorotationalShape& shape = *block.shape();
    const ModalShape& modal = shape.modal();
    const Range &u = block.unknowns(), &p = block.places();
    VectorXd s = modal_velocity.segment(u.first, u.count);
    auto at = next.modal.segment(u.first, u.count);
    const double momentum = modal.inertia(modal.deformed(at)) * s[2];
    at += rule.dt * s;
    s[2] = momentum / modal.inertia(modal.deformed(at));
    next.position.middleCols(p.first, p.count) =
        (turned_by(at[2]) * modal.deformed_places(at)).colwise() + Vec2(at.head<2>());
    next.carried.segment(u.first, u.count) = unknowns_of(shape, modal.node_velocities(at, s));
    block.follow_with_origin(next);
  });
}

}  // namespace ddacontact
