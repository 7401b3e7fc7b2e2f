/// \file The frames of a run: results.pvd and contacts.pvd with the files they list.
#pragma once

#include <ddacontact/output/frame_options.hpp>
#include <polyfem/io/pvd_file.hpp>

#include <filesystem>
#include <optional>
#include <vector>

namespace ddacontact {

/// Files are listed once they are whole. Everything throws OutputError.
class FrameWriter {
 public:
  /// Starts both series anew in a directory that is there, and removes the frames of an earlier run.
  FrameWriter(const std::filesystem::path& directory, const FrameOptions& options);
  /// Goes on with the first n frames of `source`, which may be the directory itself, when they are there;
  /// otherwise begins anew, see `goes_on`.
  FrameWriter(const std::filesystem::path& directory, const FrameOptions& options,
              const std::filesystem::path& source, int n_frames);

  bool goes_on() const { return goes_on_; }
  int n_frames() const { return n_frames_; }

  /// A frame of the present state, when its step is one of those wanted.
  void write_step(const Stepper& stepper, const Labels& labels);
  /// A frame of the present state, unless it is written already: how a run ends.
  void write_last(const Stepper& stepper, const Labels& labels);

 private:
  struct Series {
    std::vector<polyfem::PvdEntry> blocks, contacts;
  };
  static Series read_series(const std::filesystem::path& source, int n_frames);
  FrameWriter(const std::filesystem::path& directory, const FrameOptions& options,
              const std::filesystem::path& source, Series series);

  void write(const Frame& frame);

  std::filesystem::path directory_;
  FrameOptions options_;
  polyfem::PvdFile results_, contacts_;
  int n_frames_ = 0;
  bool goes_on_ = false;
  std::optional<double> last_time_;
};

}  // namespace ddacontact
