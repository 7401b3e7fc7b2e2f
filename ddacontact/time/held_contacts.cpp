#include <ddacontact/time/held_contacts.hpp>

#include <ddacontact/time/rigid_velocities.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

/// Rates of closed contacts below this part of what gravity makes in the step are left to themselves.
constexpr double negligible_rate = 1e-9;
/// Of normal impulses and the friction that goes with them, when rates are taken out.
constexpr int most_friction_rounds = 20;

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

}  // namespace

HoldReport hold_closed_contacts(BlockSystem& blocks, const std::vector<Contact>& all, const VectorXd& d,
                                double dt, BlockState& next) {
  std::vector<HeldContact> held;
  std::vector<const Contact*> contacts;
  bool moves = false;
  for (const Contact& contact : all) {
    if (contact.normal <= 0) continue;
    HeldContact rates = rates_at(contact, d);
    rates.tangential = contact.history.state == ContactState::stick;
    const double negligible =
        std::max(negligible_rate * blocks.gravity.norm() * dt, 1e-12 * contact.size / dt);
    moves = moves || std::abs(rates.gap.change(next.velocity)) > negligible ||
            (rates.tangential && std::abs(rates.slip.change(next.velocity)) > negligible);
    held.push_back(rates);
    contacts.push_back(&contact);
  }
  if (!moves) return {};
  blocks.prepare(next);
  // Friction of sliding contacts follows the normal impulses, which follow it: a few rounds settle that,
  // unless what friction changes asks for ever more of it.
  VectorXd normal = VectorXd::Zero(static_cast<Index>(held.size())), shear = normal;
  HoldReport result;
  VectorXd without_friction;
  for (int round = 0; round < most_friction_rounds; ++round) {
    const JumpReport report = hold(blocks, held, next.velocity);
    next.velocity += report.jump;
    if (round == 0) without_friction = next.velocity;
    VectorXd impulses = VectorXd::Zero(next.velocity.size());
    bool changed = false;
    for (std::size_t c = 0; c < held.size(); ++c) {
      const Contact& contact = *contacts[c];
      if (held[c].tangential || !contact.law.has_friction()) continue;
      const Index k = static_cast<Index>(c);
      normal[k] += report.impulses[c].normal;
      const double N = std::max(0.0, contact.normal + normal[k] / dt);
      const double change =
          dt * (std::copysign(shear_bound(contact.law, N, false), contact.shear) - contact.shear) - shear[k];
      changed = changed || std::abs(change) > 1e-9 * dt * std::abs(contact.shear);
      shear[k] += change;
      held[c].slip.add_gradient(change, impulses);
    }
    if (!changed) return result;
    const VectorXd before = next.velocity;
    for (int b = 0; b < blocks.n_blocks(); ++b) {
      if (!blocks.is_free(b)) continue;
      const Block& block = blocks.block(b);
      const Range& u = block.unknowns();
      const auto& modes = block.rigid_modes();
      const Vec3 inertia = (modes.transpose() * block.mass() * modes).diagonal();
      next.velocity.segment(u.first, u.count) +=
          modes * (modes.transpose() * impulses.segment(u.first, u.count)).cwiseQuotient(inertia);
    }
    result.friction_loss -= impulses.dot(before + next.velocity) / 2;
  }
  next.velocity = without_friction;
  return {.settled = false};
}

}  // namespace ddacontact
