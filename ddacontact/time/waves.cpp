#include <ddacontact/time/waves.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

double transit_time(const Block& block) {
  const double density = block.mass_total() / block.reference_area();
  assert(density > 0);
  return block.size() / std::sqrt(block.material().elasticity(0, 0) / density);
}

double impact_duration(const BlockSystem& blocks, const Contact& contact) {
  double least = inf;
  for (int b : contact.pair.blocks())
    if (blocks.is_movable(b)) least = std::min(least, transit_time(blocks.block(b)));
  return least;
}

}  // namespace ddacontact
