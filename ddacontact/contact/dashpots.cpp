#include <ddacontact/contact/dashpots.hpp>

#include <cmath>

namespace ddacontact {

void set_dashpots(const BlockSystem& blocks, const ContactProperties& properties, double dt,
                  std::vector<Contact>& contacts) {
  if (!properties.joints.any(&JointStrength::damps)) return;
  const auto stiffness = [&](const Contact& contact) {
    return contact.law.compliant ? contact.law.normal_stiffness : properties.normal_stiffness;
  };
  // Of each block against translations: p n n^T of its closed contacts.
  std::vector<Mat2> of_blocks(blocks.n_blocks(), Mat2::Zero());
  for (const Contact& contact : contacts) {
    if (!contact.closed()) continue;
    const Vec2 n = contact.motion.slip_positions().outwards();
    for (const int b : contact.pair.blocks()) of_blocks[b] += stiffness(contact) * n * n.transpose();
  }
  for (Contact& contact : contacts) {
    const Vec2 n = contact.motion.slip_positions().outwards();
    const double p = stiffness(contact);
    double mass = inf, k = 1;
    for (const int b : contact.pair.blocks()) {
      if (!blocks.is_movable(b) || blocks.block(b).mass_total() >= mass) continue;
      mass = blocks.block(b).mass_total();
      k = n.dot(of_blocks[b] * n) + (contact.closed() ? 0 : p);
    }
    // c = 2 zeta sqrt(k m), and of that the contact's part of k.
    const double c = 2 * properties.strength(contact.pair).dashpot * p * std::sqrt(mass / k);
    contact.damping = std::isfinite(mass) ? c / dt : 0;
  }
}

}  // namespace ddacontact
