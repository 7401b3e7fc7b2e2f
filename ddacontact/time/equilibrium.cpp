#include <ddacontact/time/equilibrium.hpp>

#include <ddacontact/time/energy_accounts.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

std::vector<double> largest_contacts(const BlockSystem& blocks, const std::vector<Contact>& contacts) {
  std::vector<double> largest(static_cast<std::size_t>(blocks.n_blocks()), 0);
  for (const Contact& contact : contacts)
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block})
      largest[b] = std::max(largest[b], std::hypot(contact.normal, contact.shear));
  return largest;
}

/// Kinetic energy and the fastest vertex.
Equilibrium find_motion(const BlockSystem& blocks, const VectorXd& velocity) {
  Equilibrium found;
  found.kinetic = kinetic_energy(blocks, velocity);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Block& block = blocks.block(b);
    const double fastest = block.furthest_vertex(velocity);
    if (fastest > found.fastest) {
      found.fastest = fastest;
      found.fastest_block = b;
    }
    found.relative_speed = std::max(found.relative_speed, fastest / block.size());
  }
  return found;
}

/// Notes what is left of forces on a block, the largest of which is given.
void judge(int b, double left, double largest, Equilibrium& found) {
  if (largest == 0) return;  // round-off of a motion without forces
  if (left > largest_unbalanced * largest) ++found.n_unbalanced;
  if (left > found.unbalanced * largest) {
    found.unbalanced = left / largest;
    found.unbalanced_block = b;
  }
}

}  // namespace

Equilibrium find_equilibrium(const BlockSystem& blocks, const std::vector<BlockForceSum>& forces,
                             const std::vector<Contact>& contacts, const VectorXd& velocity) {
  Equilibrium found = find_motion(blocks, velocity);
  const std::vector<double> of_contacts = largest_contacts(blocks, contacts);
  for (int b = 0; b < blocks.n_blocks(); ++b)
    if (!blocks.is_unchanging(b) && blocks.is_movable(b))
      judge(b, forces[b].resultant, std::max(of_contacts[b], forces[b].largest), found);
  return found;
}

Equilibrium find_equilibrium(const BlockSystem& blocks, const StepSystem& system, const Residual& residual,
                             const std::vector<Contact>& contacts, const Points& reactions,
                             const VectorXd& velocity) {
  const std::vector<double> largest_contact = largest_contacts(blocks, contacts);
  VectorXd total = residual.external;
  for (const PrescribedDof& held : blocks.prescribed_dofs())
    total[held.unknown] += residual.force[held.unknown];

  Equilibrium found = find_motion(blocks, velocity);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Block& block = blocks.block(b);
    if (!blocks.is_movable(b)) continue;  // what supports drive has no balance of its own
    judge(b, size_of_forces(block, total),
          std::max(largest_contact[b], largest_force(system, block, reactions)), found);
  }
  return found;
}

}  // namespace ddacontact
