/// \file Where a field exceeds given levels.
#pragma once

#include <ddacontact/picture/fan_mesh.hpp>

#include <vector>

namespace ddacontact {

/// The boundary of the region where the linear interpolant of `values` (one a node) is at least a level:
/// closed polygons, counter-clockwise outside, clockwise round holes.
using Region = std::vector<std::vector<Vec2>>;

/// One region for each of the ascending levels. Nodes of the outline between corners are left out where the
/// region's boundary passes them straight.
std::vector<Region> superlevel_regions(const FanMesh& mesh, const Points& nodes, const VectorXd& values,
                                       const std::vector<double>& levels);

}  // namespace ddacontact
