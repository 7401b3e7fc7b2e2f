/// \file Which moments of a run are kept, and what of them.
#pragma once

#include <ddacontact/output/frame.hpp>

namespace ddacontact {

/// What `[output]` of a scene says of frames.
struct FrameOptions {
  int every = 1;  ///< a frame every so many steps, the start among them; 0: only the last
  bool displacement = true, velocity = true, stress = true, principal = true;  ///< arrays to write
  int n_threads = 1;  ///< that deflate arrays; the files are the same for any number
  bool skip = true;   ///< false: what is not requested is computed all the same, not written
  int refine = 0;     ///< 0: blocks as polygons; n: each triangle of their fans about the centroid as n x n

  FrameFields fields() const { return {displacement, velocity, stress || principal}; }
};

}  // namespace ddacontact
