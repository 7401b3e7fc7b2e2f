/// \file The frames of a run: results.pvd and contacts.pvd with the files they list.
#pragma once

#include <ddacontact/output/frame_options.hpp>
#include <polyfem/io/pvd_file.hpp>

#include <filesystem>
#include <optional>

namespace ddacontact {

/// Files are listed once they are whole. Everything throws OutputError.
class FrameWriter {
 public:
  /// Starts both series anew in a directory that is there, and removes the frames of an earlier run.
  FrameWriter(const std::filesystem::path& directory, const FrameOptions& options);

  /// A frame of the present state, when its step is one of those wanted.
  void write_step(const Stepper& stepper, const Labels& labels);
  /// A frame of the present state, unless it is written already: how a run ends.
  void write_last(const Stepper& stepper, const Labels& labels);

 private:
  void write(const Frame& frame);

  std::filesystem::path directory_;
  FrameOptions options_;
  polyfem::PvdFile results_, contacts_;
  int n_frames_ = 0;
  std::optional<double> last_time_;
};

}  // namespace ddacontact
