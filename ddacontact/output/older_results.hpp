/// \file What becomes of older results when a scene is run again, and of an edited file when it is made
/// again.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ddacontact {

/// Held by a run on its result directory, for others to see. Where the file system knows no locks there is
/// none.
class DirectoryLock {
 public:
  /// Throws OutputError where another run holds it.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

  /// Throws OutputError where another run holds it: to be asked before anything in the directory changes.
  static void expect_free(const std::filesystem::path& directory);

 private:
  int descriptor_;
};

/// Whether a run writes a file of this name into its directory.
bool is_result_file(const std::string& name);
/// Whether a run, a search or a sweep has written to it.
bool holds_results(const std::filesystem::path& directory);

/// Throws OutputError where no run has written to a directory, and yet a file is there that one would write.
void expect_no_others_files(const std::filesystem::path& directory);

/// Renames a directory that holds results to DIRECTORY.1, or the first number that is free, and
/// returns the new name; nothing where there are no results. Throws OutputError when it cannot be renamed or
/// another run writes to it.
std::optional<std::filesystem::path> keep_older_results(const std::filesystem::path& directory);

/// Renames a file that holds another text, rock.toml to rock.1.toml or the first number that is free, and
/// returns the new name; nothing where there is no such file. Throws OutputError when it cannot be renamed.
std::optional<std::filesystem::path> keep_older_file(const std::filesystem::path& file,
                                                     std::string_view text);

}  // namespace ddacontact
