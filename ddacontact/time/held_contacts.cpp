#include <ddacontact/time/held_contacts.hpp>

#include <ddacontact/time/energy_accounts.hpp>
#include <ddacontact/time/waves.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace ddacontact {

namespace {

/// Rates of closed contacts below this part of what gravity makes in the step are left to themselves, and so
/// is what moves blocks no faster.
constexpr double negligible_rate = 1e-9;
/// What friction follows the impulses is found in so many rounds.
constexpr int most_friction_rounds = 6;

/// How the friction of a contact that is not held along its edge goes with the impulses.
enum class Rubs : char {
  follows,   ///< it is at its bound under what the contact bears then
  relieved,  ///< the contact bears nothing then, and no friction
  stays      ///< to follow would make energy: the contact sticks by its elasticity
};

/// How velocities change gap and slip at the end of a step.
HeldContact rates_at(const Contact& contact, const VectorXd& d) {
  const MovingVertexEdge& m = contact.motion;
  const GapAndSlip at_d = m.rates_at(m.at(d), contact.history.lock);
  HeldContact rates;
  rates.gap = m.form(at_d.by_gap);
  rates.slip = m.form(at_d.by_slip);
  return rates;
}

std::pair<int, int> blocks_of(const Contact& contact) {
  return std::minmax(contact.pair.vertex_block, contact.pair.edge_block);
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

HeldFriction friction_of(const Contact& contact, Rubs rubs, double dt) {
  const auto& [law, N, T] = std::tie(contact.law, contact.normal, contact.shear);
  if (rubs == Rubs::stays) return {};
  if (rubs == Rubs::relieved) return {0, -dt * T};
  return {std::copysign(friction_rate(law, N), T), dt * (std::copysign(shear_bound(law, N, false), T) - T)};
}

/// What the friction of a contact's impulses dissipates, J per m.
double loss(const HeldContact& contact, std::size_t c, const VectorXd& moving, const HeldJump& jump) {
  return -jump.shear[static_cast<Index>(c)] *
         (contact.slip.change(moving) + contact.slip.change(jump.velocity) / 2);
}

}  // namespace

HeldReport hold_closed_contacts(BlockSystem& blocks, const std::vector<Contact>& all,
                                const std::vector<char>& parted, const VectorXd& d, double dt,
                                HoldFactor& factor, BlockState& next) {
  std::vector<HeldContact> held;
  std::vector<const Contact*> contacts;
  held.reserve(all.size());
  contacts.reserve(all.size());
  bool moves = false;
  const double negligible = negligible_rate * blocks.gravity.norm() * dt;
  // Where one contact of two blocks slides the others slide with it, rigid as the blocks are here. By blocks:
  // what friction has taken in the step, which impulses may give back.
  std::map<std::pair<int, int>, double> rubbed;
  for (const Contact& contact : all)
    if (contact.normal > 0 && is_slipping(contact.history.state))
      rubbed[blocks_of(contact)] -= contact.shear * contact.slip_change;
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Contact& contact = all[c];
    if (contact.normal <= 0 || (!parted.empty() && parted[c]) || carries_waves(blocks, contact, dt)) continue;
    HeldContact rates = rates_at(contact, d);
    rates.tangential = contact.history.state == ContactState::stick && !rubbed.contains(blocks_of(contact));
    const double least = std::max(negligible, 1e-12 * contact.size / dt);
    moves = moves || std::abs(rates.gap.change(next.velocity)) > least ||
            (rates.tangential && std::abs(rates.slip.change(next.velocity)) > least);
    held.push_back(rates);
    contacts.push_back(&contact);
  }
  if (!moves) return {};
  blocks.prepare(next);
  const VectorXd moving = next.velocity;
  const Hold hold(blocks, held, negligible, factor);
  const VectorXd jump = hold.jump(moving);
  if (jump.isZero(0)) return {};  // no impulses that friction could follow
  next.velocity += jump;

  std::vector<std::size_t> rubbing;
  for (std::size_t c = 0; c < held.size(); ++c)
    if (!held[c].tangential && contacts[c]->law.has_friction()) rubbing.push_back(c);
  if (rubbing.empty()) return {};
  std::vector<Rubs> rubs(held.size(), Rubs::stays);
  std::vector<HeldFriction> friction(held.size());
  for (std::size_t c : rubbing) rubs[c] = Rubs::follows;
  bool settled = false;
  for (int round = 0; round < most_friction_rounds && !settled; ++round) {
    for (std::size_t c : rubbing) friction[c] = friction_of(*contacts[c], rubs[c], dt);
    const HeldJump with_friction = hold.with_friction(jump, friction, true);
    settled = with_friction.settled;
    for (std::size_t c : rubbing) {
      const auto of_blocks = rubbed.find(blocks_of(*contacts[c]));
      const double given_back = of_blocks == rubbed.end() ? 0 : std::max(0.0, of_blocks->second),
                   left = contacts[c]->normal + with_friction.normal[static_cast<Index>(c)] / dt;
      Rubs now = left < 0 ? Rubs::relieved : Rubs::follows;
      if (rubs[c] == Rubs::stays || loss(held[c], c, moving, with_friction) + given_back < 0)
        now = Rubs::stays;
      settled = settled && now == rubs[c];
      rubs[c] = now;
    }
  }
  HeldReport report{0, false};
  if (settled) {
    const HeldJump with_friction = hold.with_friction(jump, friction);
    double most_energy = kinetic_energy(blocks, moving);
    for (std::size_t c : rubbing) report.friction_loss += loss(held[c], c, moving, with_friction);
    double rubbed_at_all = 0;
    for (const auto& [of, by_blocks] : rubbed) rubbed_at_all += by_blocks;
    next.velocity = moving + with_friction.velocity;
    most_energy += std::max(rubbed_at_all, 0.0) +
                   work_of_supports(blocks, held, with_friction.normal, with_friction.shear, next.velocity);
    // Written so that what is not a number is refused.
    report.settled = with_friction.settled && kinetic_energy(blocks, next.velocity) <= most_energy;
  }
  if (report.settled) return report;
  next.velocity = moving + jump;
  return {0, false};
}

}  // namespace ddacontact
