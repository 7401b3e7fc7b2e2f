/// \file A time series of files for ParaView, .pvd.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace polyfem {

/// One file of a series.
struct PvdEntry {
  double time = 0;
  long step = 0;     ///< in an attribute of our own, which other readers pass over
  std::string file;  ///< relative to the series' directory
};

/// A series in the making. Each entry takes the place of the file's last lines in one write, so that the
/// series is whole after each, whenever the program ends, and costs the same however long it is.
class PvdFile {
 public:
  /// Starts an empty series in place of an older one. Throws FileError.
  explicit PvdFile(const std::filesystem::path& path) : PvdFile(path, {}) {}
  /// The same with entries: the older series stays until this one is whole.
  PvdFile(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);
  /// Throws FileError; the series is then as it was before.
  void add(const PvdEntry& entry);

 private:
  /// Puts the closing lines back behind the last entry, where there is room for them.
  void restore_end();

  std::filesystem::path path_;
  std::ofstream out_;
  std::streamoff end_ = 0;  ///< of the last entry
};

/// The entries of a series. Throws FileError, which names the file, when it is missing or damaged.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace polyfem
