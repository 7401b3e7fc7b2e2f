/// \file A frame with what a page shows of it.
#pragma once

#include <ddacontact/page/cell_stress_fit.hpp>

#include <vector>

namespace ddacontact {

/// Which arrays a page holds; what frames do not hold cannot be requested.
struct PageArrays {
  bool displacement = true;  ///< false: positions still change, relative to the reference
  bool velocity = true, stress = true;
  /// Of a large run: numbers to two digits, stress constant in each cell of a divided block.
  bool is_large = false;
};

/// A frame with the stress of its cells.
struct PageFrame {
  Frame frame;
  std::vector<CellStressFit> stress;  ///< of each cell; empty where the frame holds no stress
};

/// The arrays that a frame holds.
PageArrays arrays_of(const Frame& frame);

/// Fits the stress of every cell where the frame holds it.
PageFrame page_frame(Frame frame);

}  // namespace ddacontact
