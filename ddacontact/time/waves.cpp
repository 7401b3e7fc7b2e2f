#include <ddacontact/time/waves.hpp>

#include <cassert>
#include <cmath>

namespace ddacontact {

double transit_time(const Block& block) {
  const double density = block.mass_total() / block.reference_area();
  assert(density > 0);
  return block.size() / std::sqrt(block.material().elasticity(0, 0) / density);
}

bool carries_waves(const BlockSystem& blocks, const Contact& contact, double dt) {
  for (int b : contact.pair.blocks())
    if (blocks.is_movable(b) && dt >= transit_time(blocks.block(b))) return false;
  return true;
}

}  // namespace ddacontact
