/// \file Arches and pillars with the load factor at which they collapse, from statics alone.
#pragma once

#include <ddacontact/scene/scene.hpp>

#include <string>
#include <vector>

namespace support {

/// A structure of rigid blocks under its weight and loads.
struct LimitStructure {
  std::string name;
  ddacontact::Scene scene;  ///< static; loads at factor 1
  double limit = 0;         ///< the factor of the loads at which it collapses
};

/// The scene with its loads times a factor.
ddacontact::Scene with_loads(const LimitStructure& structure, double factor);

/// Random structures, half of them arches of 5 to 15 voussoirs between fixed springers that carry a point
/// load, a horizontal body force or a vertical one on one half, the others pillars of 1 to 6 blocks under a
/// horizontal body force.
///
/// The limit of an arch is the largest factor for which a thrust line passes all joints, |M| <= N t/2 and
/// |T| <= mu N (Heyman): a linear program in the thrust, its moment and the factor. Arches whose limit
/// friction decides are left out: there, sliding without dilation makes it an upper bound. A pillar of width
/// b turns over about the toe of its base at b/h, h its height, or slides at mu. Blocks have E = 350 GPa: of
/// 35 GPa a quarter of the arches deform so much at .97 of the limit of rigid ones that they collapse.
std::vector<LimitStructure> limit_structures(int number, unsigned seed);

}  // namespace support
