#include <ddacontact/time/equilibrium.hpp>

#include <ddacontact/block/block_motion.hpp>
#include <ddacontact/core/tolerances.hpp>
#include <ddacontact/time/energy_accounts.hpp>

#include <algorithm>
#include <cmath>

namespace ddacontact {

namespace {

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

/// |force| or |moment| / size, the larger.
double larger(const Block& block, const Vec2& force, double moment) {
  return std::max(force.norm(), std::abs(moment) / block.size());
}

}  // namespace

Equilibrium find_equilibrium(const StepSystem& system, const TrialSolution& solution,
                             const std::vector<Contact>& contacts, const BlockState& before,
                             const Points& reactions, const VectorXd& velocity) {
  const BlockSystem& blocks = system.blocks();
  std::vector<double> of_contacts(static_cast<std::size_t>(blocks.n_blocks()), 0);  // the largest
  for (const Contact& contact : contacts)
    for (int b : contact.pair.blocks())
      of_contacts[b] = std::max(of_contacts[b], std::hypot(contact.normal, contact.shear));
  VectorXd total = solution.residual.external;
  for (const PrescribedDof& held : blocks.prescribed_dofs())
    total[held.unknown] += solution.residual.force[held.unknown];

  Equilibrium found = find_motion(blocks, velocity);
  VectorXd turning;
  for (int b = 0; b < blocks.n_blocks(); ++b) {
    // What supports drive has no balance of its own.
    if (blocks.is_unchanging(b) || !blocks.is_movable(b)) continue;
    const Block& block = blocks.block(b);
    const Range& u = block.unknowns();
    turning.resize(u.count);
    block.rotation(before, turning);
    const auto size_of = [&](const VectorXd& forces) {
      return larger(block, block.translations().transpose() * u.of(forces), turning.dot(u.of(forces)));
    };
    double left = size_of(total);
    if (const BlockMotion* motion = system.step(b).motion()) {
      const Vec3 momentum = motion->resultant(u.of(solution.straight));
      left = larger(block, momentum.head<2>(), momentum[2]);
    }
    const double largest =
        std::max({of_contacts[b], size_of(system.gravity_forces()), size_of(system.load_forces()),
                  block.points().columns_of(reactions).colwise().norm().maxCoeff()});
    const double round_off = few_ulps * block.material().elasticity(0, 0) * block.size();
    if (largest <= round_off) continue;
    if (left > largest_unbalanced * largest) ++found.n_unbalanced;
    if (left > found.unbalanced * largest) {
      found.unbalanced = left / largest;
      found.unbalanced_block = b;
    }
  }
  return found;
}

}  // namespace ddacontact
