#include <ddacontact/contact/dashpots.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace ddacontact {

void set_dashpots(const BlockSystem& blocks, const ContactProperties& properties, double dt,
                  std::vector<Contact>& contacts) {
  assert(dt > 0);
  if (!properties.joints.any(&JointStrength::damps)) return;
  // Of each block against translations: p n n^T of its closed contacts.
  std::vector<Mat2> of_blocks(blocks.n_blocks(), Mat2::Zero());
  for (const Contact& contact : contacts)
    for (const int b : contact.pair.blocks())
      if (const Vec2 n = contact.motion.slip_positions().outwards(); contact.closed())
        of_blocks[b] += contact.law.normal_stiffness * n * n.transpose();
  for (Contact& contact : contacts) {
    const Vec2 n = contact.motion.slip_positions().outwards();
    const double p = contact.law.normal_stiffness;
    const bool any_free =
        blocks.is_free(contact.pair.vertex_block) || blocks.is_free(contact.pair.edge_block);
    double mass_over_k = inf;
    for (const int b : contact.pair.blocks())
      if (any_free ? blocks.is_free(b) : blocks.is_movable(b))
        mass_over_k = std::min(mass_over_k, blocks.block(b).mass_total() /
                                                (n.dot(of_blocks[b] * n) + (contact.closed() ? 0 : p)));
    // c = 2 zeta sqrt(k m), and of that the contact's part of k.
    const double c = 2 * properties.strength(contact.pair).dashpot * p * std::sqrt(mass_over_k);
    contact.damping = std::isfinite(c) ? c / dt : 0;
  }
}

}  // namespace ddacontact
