/// \file The pressure of water at rest on an edge.
#pragma once

#include <ddacontact/core/water.hpp>

namespace ddacontact {

/// A part of an edge of a block, in fractions of it.
struct WetFace {
  int block = 0, edge = 0;
  double from = 0, to = 1;
  bool in_joint = false;  ///< touches another block
};

/// Forces at both ends of an edge, N per m.
struct EdgeForces {
  Vec2 start{0, 0}, end{0, 0};
};

/// Forces of the pressure `unit_weight` (N/m3) times the depth below a table on the part [from, to] of an
/// edge of a counter-clockwise outline: exact for shape functions that are linear along it.
EdgeForces water_forces(const Points& table, double unit_weight, const Vec2& start, const Vec2& end,
                        double from, double to);

}  // namespace ddacontact
