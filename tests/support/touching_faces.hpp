/// \file Where polygons touch, from their outlines alone. Written for the tests' reference solutions: it
/// shares nothing with the library's contact detection.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace support {

using polyfem::Points;
using polyfem::Vec2;

/// A point at which two blocks press on each other across a common tangent.
struct ContactPoint {
  int one = 0, other = 0;
  Vec2 at{0, 0};      ///< m
  Vec2 normal{0, 0};  ///< unit, from `other` into `one`
};

/// A corner that touches a corner and nothing else there: every line between the two wedges separates them.
struct CornerContact {
  int one = 0, other = 0;
  Vec2 at{0, 0};                 ///< m
  Vec2 first{0, 0}, last{0, 0};  ///< the extreme normals, unit, from `other` into `one`; counter-clockwise
};

struct Touching {
  std::vector<ContactPoint> points;
  std::vector<CornerContact> corners;
};

/// Faces that lie on each other touch at the two ends of their common part, a lone corner on a face at the
/// corner. Distances below 1e-7 of the smaller block's size count as zero.
/// \param[in] outlines  simple polygons, counter-clockwise
Touching touching_faces(const std::vector<Points>& outlines);

}  // namespace support
