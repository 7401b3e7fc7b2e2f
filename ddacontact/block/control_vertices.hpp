/// \file Vertices whose displacements determine an affine displacement field.
#pragma once

#include <ddacontact/core/types.hpp>

#include <array>
#include <vector>

namespace ddacontact {

/// Three vertices whose displacements in x, and three (often the same) whose displacements in y determine an
/// affine displacement field. Fixed ones are preferred, so that fixing eliminates their unknowns.
struct ControlVertices {
  static constexpr int n = 3;
  std::array<int, n> x, y;
};

/// Control vertices that include as many of the fixed ones (`fixed_x[v]`, `fixed_y[v]`) as three can be.
ControlVertices choose_control_vertices(const PointsRef& outline, const std::vector<bool>& fixed_x,
                                        const std::vector<bool>& fixed_y);

}  // namespace ddacontact
