#include <ddacontact/time/equilibrium.hpp>

#include <ddacontact/time/energy_accounts.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

Equilibrium find_equilibrium(const BlockSystem& blocks, const StepSystem& system, const Residual& residual,
                             const std::vector<Contact>& contacts, const Points& reactions,
                             const VectorXd& velocity) {
  std::vector<double> largest_contact(blocks.n_blocks(), 0);
  for (const Contact& contact : contacts)
    for (int b : {contact.pair.vertex_block, contact.pair.edge_block})
      largest_contact[b] = std::max(largest_contact[b], std::hypot(contact.normal, contact.shear));
  VectorXd total = residual.external;
  for (const HeldUnknown& held : blocks.held_unknowns()) total[held.unknown] += residual.force[held.unknown];

  Equilibrium found;
  found.kinetic = kinetic_energy(blocks, velocity);
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    if (blocks.is_unchanging(b)) continue;
    const Block& block = blocks.block(b);
    double fastest = 0;
    for (int v = 0; v < block.n_vertices(); ++v)
      fastest = std::max(fastest, block.vertex_map(v)(velocity).norm());
    if (fastest > found.fastest) {
      found.fastest = fastest;
      found.fastest_block = b;
    }
    found.relative_speed = std::max(found.relative_speed, fastest / block.size());

    if (!blocks.is_movable(b)) continue;  // what supports drive has no balance of its own
    const Range &u = block.unknowns(), &places = block.places();
    const auto size_of = [&](const VectorXd& forces) {
      const auto of_block = forces.segment(u.first, u.count);
      const Vec2 resultant = block.translations().transpose() * of_block;
      return std::max(resultant.norm(), std::abs(block.rotation().dot(of_block)) / block.size());
    };
    const double largest =
        std::max({largest_contact[b], size_of(system.gravity_forces()), size_of(system.load_forces()),
                  reactions.middleCols(places.first, places.count).colwise().norm().maxCoeff()});
    const double left = size_of(total);
    if (left > largest_unbalanced * largest) ++found.n_unbalanced;
    if (left > found.unbalanced * largest) {
      found.unbalanced = left / largest;
      found.unbalanced_block = b;
    }
  }
  return found;
}

}  // namespace ddacontact
