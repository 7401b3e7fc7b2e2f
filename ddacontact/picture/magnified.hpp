/// \file Frames with larger displacements, to be seen.
#pragma once

#include <ddacontact/output/frame.hpp>

namespace ddacontact {

/// The frame with its points, and contacts with their vertices, at the start plus `factor` times the
/// displacement. Fields stay as they are: of stress only those of the frame itself are right, see
/// Panel::values. Throws Error when the frame does not hold displacements.
Frame magnified(const Frame& frame, double factor);

}  // namespace ddacontact
