/// \file Vertices by whose displacements an affine field is told.
#pragma once

#include <ddacontact/core/types.hpp>

#include <array>
#include <vector>

namespace ddacontact {

/// Three vertices by whose displacements in x, and three (often the same) by whose displacements in y, an
/// affine field can be told. With fixed vertices among them, fixing is leaving out their unknowns.
struct ControlVertices {
  static constexpr int n = 3;
  std::array<int, n> x, y;
};

/// Control vertices that include as many of the fixed ones (`fixed_x[v]`, `fixed_y[v]`) as three can be.
ControlVertices choose_control_vertices(const PointsRef& outline, const std::vector<bool>& fixed_x,
                                        const std::vector<bool>& fixed_y);

}  // namespace ddacontact
