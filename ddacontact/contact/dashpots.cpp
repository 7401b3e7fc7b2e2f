#include <ddacontact/contact/dashpots.hpp>

#include <cmath>

namespace ddacontact {

namespace {

double stiffness(const ContactProperties& properties, const Contact& contact) {
  return contact.law.compliant ? contact.law.normal_stiffness : properties.normal_stiffness;
}

Vec2 normal(const Contact& contact) {
  const VertexEdgePositions at = contact.motion.slip_positions();
  const Vec2 along = (at.k - at.j).normalized();
  return {along.y(), -along.x()};
}

/// Of each block against translations: the sum of p n n^T of its closed contacts.
std::vector<Mat2> stiffnesses(const BlockSystem& blocks, const ContactProperties& properties,
                              const std::vector<Contact>& contacts) {
  std::vector<Mat2> sums(blocks.n_blocks(), Mat2::Zero());
  for (const Contact& contact : contacts) {
    if (!contact.closed()) continue;
    const Vec2 n = normal(contact);
    for (const int b : contact.pair.blocks()) sums[b] += stiffness(properties, contact) * n * n.transpose();
  }
  return sums;
}

/// The lighter one of those that move; -1: none does.
int lighter_block(const BlockSystem& blocks, const VertexEdge& pair) {
  int lighter = -1;
  for (const int b : pair.blocks())
    if (blocks.is_movable(b) &&
        (lighter < 0 || blocks.block(b).mass_total() < blocks.block(lighter).mass_total()))
      lighter = b;
  return lighter;
}

}  // namespace

void set_dashpots(const BlockSystem& blocks, const ContactProperties& properties, double dt,
                  std::vector<Contact>& contacts) {
  if (!properties.joints.any(&JointStrength::damps)) return;
  const std::vector<Mat2> of_blocks = stiffnesses(blocks, properties, contacts);
  for (Contact& contact : contacts) {
    const int b = lighter_block(blocks, contact.pair);
    if (b < 0) continue;
    // c = 2 zeta sqrt(k m) of the block, and of that the part of the contact in its stiffness k.
    const Vec2 n = normal(contact);
    const double p = stiffness(properties, contact), k = n.dot(of_blocks[b] * n) + (contact.closed() ? 0 : p);
    contact.damping =
        2 * properties.strength(contact.pair).dashpot * p * std::sqrt(blocks.block(b).mass_total() / k) / dt;
  }
}

}  // namespace ddacontact
