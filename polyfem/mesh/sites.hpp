/// \file Sites of a Voronoi diagram: random ones, and evenly spread ones by Lloyd's method.
#pragma once

#include <polyfem/core/types.hpp>

#include <cstdint>

namespace polyfem {

/// Points distributed uniformly over a simple polygon. The same seed gives the same bytes on every platform.
Points random_sites(const PointsRef& domain, int n_sites, std::uint64_t seed);

/// One step of Lloyd's method: each site moves to the centroid of its Voronoi cell within the domain. The
/// centroid is that of some 25 sample points a cell, good to about 3 % of the cell's size; no diagram is
/// computed. A site whose centroid lies outside the domain (around a concave corner) stays.
Points lloyd_step(const PointsRef& domain, const Points& sites);

}  // namespace polyfem
