#include <ddacontact/time/held_contacts.hpp>

#include <ddacontact/solver/anderson.hpp>
#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/rigid_velocities.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace ddacontact {

namespace {

/// Rates of closed contacts below this part of what gravity makes in the step are left to themselves.
constexpr double negligible_rate = 1e-9;
/// Of normal impulses and the friction that goes with them, when rates are taken out.
constexpr int most_friction_rounds = 30, anderson_depth = 5;
/// So many rounds have to bring them nearer by half, or it is given up.
constexpr int patient_rounds = 4;
/// They agree to this part of the largest.
constexpr double settled_friction = 1e-9;

/// How velocities change gap and slip at the end of a step.
HeldContact rates_at(const Contact& contact, const VectorXd& d) {
  const MovingVertexEdge& m = contact.motion;
  const VertexEdgePlace place = m.at(d);
  HeldContact rates;
  const VertexEdgeGradient across = gap_gradient(place), along = slip_gradient(place, contact.history.lock);
  for (const auto& [form, gradient] : {std::pair{&rates.gap, &across}, std::pair{&rates.slip, &along}}) {
    m.i.add_to(*form, gradient->i);
    m.j.add_to(*form, gradient->j);
    m.k.add_to(*form, gradient->k);
  }
  return rates;
}

std::pair<int, int> blocks_of(const Contact& contact) {
  return std::minmax(contact.pair.vertex_block, contact.pair.edge_block);
}

/// Adds the impulses of a jump, by contact.
void add_impulses(const JumpReport& report, VectorXd& normal, VectorXd& sticking) {
  for (std::size_t c = 0; c < report.impulses.size(); ++c) {
    normal[static_cast<Index>(c)] += report.impulses[c].normal;
    sticking[static_cast<Index>(c)] += report.impulses[c].shear;
  }
}

/// What supports in motion do through impulses, J per m.
double work_of_supports(const BlockSystem& blocks, const std::vector<HeldContact>& contacts,
                        const VectorXd& normal, const VectorXd& shear, const VectorXd& velocity) {
  VectorXd of_supports = VectorXd::Zero(velocity.size());
  for (const HeldUnknown& held : blocks.held_unknowns()) of_supports[held.unknown] = velocity[held.unknown];
  if (of_supports.isZero(0)) return 0;
  double work = 0;
  for (std::size_t c = 0; c < contacts.size(); ++c)
    work -= normal[static_cast<Index>(c)] * contacts[c].gap.change(of_supports) +
            shear[static_cast<Index>(c)] * contacts[c].slip.change(of_supports);
  return work;
}

/// Impulses on the unknowns of free blocks, as rigid bodies.
void push(const BlockSystem& blocks, const VectorXd& impulses, VectorXd& velocity) {
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (!blocks.is_free(b)) continue;
    const Block& block = blocks.block(b);
    const Range& u = block.unknowns();
    const auto& modes = block.rigid_modes();
    const Vec3 inertia = (modes.transpose() * block.times_mass(modes)).diagonal();
    velocity.segment(u.first, u.count) +=
        modes * (modes.transpose() * impulses.segment(u.first, u.count)).cwiseQuotient(inertia);
  }
}

}  // namespace

HeldReport hold_closed_contacts(BlockSystem& blocks, const std::vector<Contact>& all,
                                const std::vector<char>& parted, const VectorXd& d, double dt,
                                BlockState& next) {
  std::vector<HeldContact> held;
  std::vector<const Contact*> contacts;
  bool moves = false;
  // Where one contact of two blocks slides the others slide with it, rigid as the blocks are here.
  std::set<std::pair<int, int>> sliding;
  for (const Contact& contact : all)
    if (contact.normal > 0 && is_slipping(contact.history.state)) sliding.insert(blocks_of(contact));
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Contact& contact = all[c];
    if (contact.normal <= 0 || (!parted.empty() && parted[c]) || carries_waves(blocks, contact, dt)) continue;
    HeldContact rates = rates_at(contact, d);
    rates.tangential = contact.history.state == ContactState::stick && !sliding.contains(blocks_of(contact));
    const double negligible =
        std::max(negligible_rate * blocks.gravity.norm() * dt, 1e-12 * contact.size / dt);
    moves = moves || std::abs(rates.gap.change(next.velocity)) > negligible ||
            (rates.tangential && std::abs(rates.slip.change(next.velocity)) > negligible);
    held.push_back(rates);
    contacts.push_back(&contact);
  }
  if (!moves) return {};
  blocks.prepare(next);
  const VectorXd moving = next.velocity;
  Hold hold(blocks, held);
  const JumpReport first = hold.jump(moving);
  next.velocity += first.jump;
  const VectorXd without_friction = next.velocity;

  // Friction of sliding contacts follows the normal impulses, which follow it.
  VectorXd normal = VectorXd::Zero(static_cast<Index>(held.size())), sticking = normal, shear = normal;
  add_impulses(first, normal, sticking);
  AndersonAcceleration acceleration(anderson_depth);
  HeldReport report;
  report.settled = false;
  double best = std::numeric_limits<double>::infinity();
  int since_best = 0;
  for (int round = 0; round < most_friction_rounds && !report.settled; ++round) {
    VectorXd change = VectorXd::Zero(normal.size());
    double largest = 0, scale = 0;
    for (std::size_t c = 0; c < held.size(); ++c) {
      const Contact& contact = *contacts[c];
      if (held[c].tangential || !contact.law.has_friction()) continue;
      const Index k = static_cast<Index>(c);
      const double N = std::max(0.0, contact.normal + normal[k] / dt);
      change[k] =
          dt * (std::copysign(shear_bound(contact.law, N, false), contact.shear) - contact.shear) - shear[k];
      largest = std::max(largest, std::abs(change[k]));
      scale = std::max(scale, dt * std::abs(contact.shear) + std::abs(shear[k]));
    }
    report.settled = largest <= settled_friction * scale;
    if (report.settled) break;
    if (largest <= best / 2) {
      best = largest;
      since_best = 0;
    } else if (++since_best == patient_rounds) {
      break;
    }
    const VectorXd was = shear;
    acceleration.advance(change, VectorXd::Ones(change.size()), shear);
    VectorXd impulses = VectorXd::Zero(next.velocity.size());
    for (std::size_t c = 0; c < held.size(); ++c) {
      const Index k = static_cast<Index>(c);
      held[c].slip.add_gradient(shear[k] - was[k], impulses);
    }
    push(blocks, impulses, next.velocity);
    const JumpReport again = hold.jump(next.velocity);
    next.velocity += again.jump;
    add_impulses(again, normal, sticking);
  }
  // It may give back friction of the step that was too much, but no more.
  double rubbed = 0;
  for (std::size_t c = 0; c < held.size(); ++c) {
    const Contact& contact = *contacts[c];
    const double rates = held[c].slip.change(moving) + held[c].slip.change(next.velocity);
    report.friction_loss -= shear[static_cast<Index>(c)] * rates / 2;
    if (is_slipping(contact.history.state)) rubbed -= contact.shear * contact.slip.change(d);
  }
  // Written so that what is not a number is refused.
  const bool sound = report.friction_loss + rubbed >= 0 &&
                     kinetic_energy(blocks, next.velocity) <=
                         kinetic_energy(blocks, moving) + std::max(rubbed, 0.0) +
                             work_of_supports(blocks, held, normal, shear + sticking, next.velocity);
  if (!report.settled || !sound) {
    next.velocity = without_friction;
    report = {0, false};
  }
  return report;
}

}  // namespace ddacontact
