/// \file A polygon divided into the cells of random, evenly spread sites.
#pragma once

#include <polyfem/mesh/polygon_mesh.hpp>

#include <cstdint>

namespace polyfem {

/// How many cells, and of what kind.
struct VoronoiOptions {
  int n_cells = 100;           ///< 1 .. 10 000 000
  std::uint64_t seed = 1;      ///< the same seed gives the same bytes
  int lloyd_steps = 3;         ///< 0: cells as irregular as random sites make them; each step evens them out
  double smallest_edge = 0.1;  ///< shorter edges are collapsed, relative to sqrt(area / n_cells); 0 .. 0.3
};

/// Voronoi cells of sites drawn uniformly from `domain` and moved by Lloyd's method, clipped to it.
///
/// Guaranteed, or Error is thrown:
/// - Cells share their vertices, and no vertex lies inside an edge of another cell. Together they fill the
///   domain: areas sum up to its area but for the rounding of coordinates.
/// - Corners of the domain are vertices, to the bit. Vertices on its edges lie on them up to rounding, on
///   horizontal and vertical ones exactly.
/// - Every cell is strictly convex: each corner turns by more than 1e-6 as a sine, and by more than 1e-3
///   unless the cell is a triangle (a needle of a domain may leave no choice).
///
/// Aimed at, and kept in a rectangle with the default options: edges not shorter than `smallest_edge`, and
/// corners that turn by 3 degrees (those of the domain apart). Where both are not to be had an edge stays if
/// taking it out would leave a corner of less than half a degree or change the outline. Around a concave
/// corner of the domain there may be small triangles. A collapse moves vertices, so cells are no longer
/// exactly those of their sites.
///
/// A convex domain is divided into exactly n_cells cells, unless it has corners that turn by less than 1e-3
/// (cut there). Around a concave corner cells are cut along diagonals and a cell may have several parts, so
/// that there are more; a site whose cell lies outside the domain altogether leaves one less.
///
/// Cells come row by row from the bottom (rows sqrt(area / n_cells) high) and in a row from the left, by
/// their centroids; vertices in the order in which cells first use them.
///
/// \param[in] domain  a simple polygon in either orientation, its area at least 1e-10 of its length squared;
///                    corners straight to round-off are left out
///
/// Throws Error for a domain with a defect, for options out of bounds, and when GEOS fails.
PolygonMesh voronoi(const PointsRef& domain, const VoronoiOptions& options = {});

}  // namespace polyfem
