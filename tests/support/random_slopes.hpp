/// \file Rock slopes cut by joint sets at random, the same for the same seed.
#pragma once

#include "limit_analysis.hpp"

#include <cstdint>

namespace support {

/// How many blocks of a slope are free.
struct SlopeSize {
  int least = 20, most = 60;
};

/// A slope 20 m high whose face looks to the left at 50 to 85 degrees; rock of 2500 kg/m3 and 35 GPa.
///
/// One joint set dips out of it at 15 degrees up to 15 below the face, a second crosses it at 50 to 130
/// degrees; spacings vary by 40 %. In one slope of three the second set is shifted from layer to layer, in
/// one of four there are joints of a third direction. A joint stops at a block that it would cut a sliver
/// from: less than a hundredth of the mean area, or a corner below 10 degrees. What lies below the toe's
/// level or behind a vertical line is fixed; only its blocks beside free ones are kept. All blocks are
/// convex, joints are closed, and of one joint law without friction. Steps are the caller's to set.
/// `turned`, `renumbered` and `reordered` of scene_changes.hpp state a slope otherwise.
ddacontact::Scene random_slope(std::uint64_t seed, const SlopeSize& size = {});

/// A slab of rows and columns of blocks on a fixed plane: whatever moves in it slides on the plane or
/// topples.
struct Slab {
  ddacontact::Scene scene;
  double dip = 0;  ///< of the plane and of the joints along it, radians
};

/// One to four layers, one to eight columns, 15 to 50 degrees; every column is wider than 1.3 times what
/// topples by width = height tan(dip). It slides as a whole for tan(phi) < tan(dip), by g (sin - cos
/// tan(phi)), and rests for more.
Slab random_slab(std::uint64_t seed);

/// The largest dip of a face between blocks not both fixed, radians; vertical ones bear nothing and do not
/// count.
double steepest_dip(const RigidBlocks& blocks);

}  // namespace support
