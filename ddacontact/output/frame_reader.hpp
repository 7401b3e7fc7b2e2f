/// \file Frames of a result directory, read back.
#pragma once

#include <ddacontact/output/frame.hpp>

#include <filesystem>
#include <vector>

namespace ddacontact {

/// One moment of a run, as the two series of a result directory list it.
struct FrameFile {
  long step = 0;
  double time = 0;
  std::filesystem::path blocks, contacts;  ///< the .vtu files of this moment
};

/// In the order of time. The last may have the step of the one before it: a run that had to stop within a
/// step.
using FrameSeries = std::vector<FrameFile>;

/// What results.pvd and contacts.pvd of a result directory list; at least one frame. Throws Error that says
/// what is missing or damaged.
FrameSeries read_series(const std::filesystem::path& directory);

/// The frame as it was captured, bit for bit; fields that were not requested have no columns. Throws
/// Error, which names the file, when it is missing, damaged or not one of ours.
Frame read_frame(const FrameFile& file);

}  // namespace ddacontact
