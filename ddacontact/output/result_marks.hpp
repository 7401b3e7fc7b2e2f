/// \file How far the histories of a run had come at some moment.
#pragma once

#include <cstdint>

namespace ddacontact {

/// The beginning of a file.
struct FileMark {
  std::uint64_t bytes = 0;
  std::uint32_t checksum = 0;  ///< polyfem::checksum of them
};

/// Of a result directory.
struct ResultMarks {
  FileMark monitors, energy, bolts, supports;
  int n_frames = 0;
};

}  // namespace ddacontact
