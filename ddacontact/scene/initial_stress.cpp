#include <ddacontact/scene/initial_stress.hpp>

#include <polyfem/geometry/area_moments.hpp>

namespace ddacontact::scene_format {

void put_initial_stress(Document& document) {
  if (!document.initial_stress || !document.locations.good("initial_stress")) return;
  const InitialStress& given = *document.initial_stress;
  for (BlockRecord& block : document.blocks) {
    if (block.locations.written("stress") || !block.locations.good("vertices") ||
        block.vertices.points.cols() < 3)
      continue;
    const double height = polyfem::area_moments(block.vertices.points).centroid.y();
    block.stress = given.stress + given.gradient * (height - given.level);
    block.stress_gradient = given.gradient;
  }
}

}  // namespace ddacontact::scene_format
