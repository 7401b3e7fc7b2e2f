/// \file The stress of a cell as a value at its centre and a linear change.
#pragma once

#include <ddacontact/output/frame.hpp>

namespace ddacontact {

/// Stress s(x) = at_centre + (change_x (x - c).x + change_y (x - c).y) / size, c the mean of the corners and
/// `size` the largest distance of a corner from it; all in Pa.
struct CellStressFit {
  Vec3 at_centre{0, 0, 0}, change_x{0, 0, 0}, change_y{0, 0, 0};
};

/// The least-squares fit to the stress halfway between the cell's centre and its corners, where gradients of
/// the shape functions are accurate; its average is the area average over the cell. Peaks that shape
/// functions have at corners are left out.
CellStressFit fit_stress(const Frame& frame, int cell);

}  // namespace ddacontact
