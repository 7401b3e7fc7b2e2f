/// \file Voronoi cells within a domain, each for itself.
#pragma once

#include <polyfem/core/types.hpp>

#include <vector>

namespace polyfem {

/// Closed polygons without common vertices, counter-clockwise, all in one array.
struct Rings {
  std::vector<Vec2> points;
  std::vector<int> offsets{
      0};  ///< ring r owns points[offsets[r]] up to, not including, points[offsets[r + 1]]

  int n_rings() const { return static_cast<int>(offsets.size()) - 1; }
};

/// The Voronoi cells of sites that differ, intersected with a simple polygon; a cell that it divides gives
/// several rings. Corners that two rings have in common agree to round-off. Computed by GEOS; throws Error
/// when it fails.
Rings clipped_voronoi_diagram(const PointsRef& domain, const Points& sites);

}  // namespace polyfem
