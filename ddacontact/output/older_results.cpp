#include <ddacontact/output/older_results.hpp>

#include <ddacontact/output/output_error.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string>

namespace ddacontact {

namespace fs = std::filesystem;

namespace {

/// With the first number that is free between name and ending.
fs::path with_number(const std::string& name, const std::string& ending) {
  std::error_code error;
  fs::path path;
  for (int number = 1; path.empty() || fs::exists(fs::symlink_status(path, error)); ++number)
    path = name + '.' + std::to_string(number) + ending;
  return path;
}

constexpr std::array result_files{"scene.toml",   "log.txt",          "energy.csv",   "monitors.csv",
                                  "blocks.csv",   "vertices.csv",     "contacts.csv", "bolts.csv",
                                  "supports.csv", "bolt_history.csv", "summary.json", "support_history.csv"};

}  // namespace

bool is_result_file(const std::string& name) {
  return std::ranges::find(result_files, name) != result_files.end();
}

bool holds_results(const fs::path& directory) {
  const std::array<const char*, 5> files{"summary.json", "energy.csv", "checkpoint.bin", "safety.json",
                                         "sweep.csv"};
  std::error_code missing;
  return std::ranges::any_of(files, [&](const char* file) { return fs::exists(directory / file, missing); });
}

void expect_no_others_files(const fs::path& directory) {
  std::error_code missing;
  if (holds_results(directory)) return;
  for (const char* file : result_files)
    if (fs::exists(directory / file, missing))
      throw OutputError(
          "\"" + (directory / file).string() +
          "\" is of no run and would be overwritten (name another directory; force overwrites it)");
}

DirectoryLock::DirectoryLock(const fs::path& directory)
    : descriptor_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  ::close(descriptor_);
  throw OutputError("\"" + directory.string() + "\" is being written by another run: name another directory");
}

DirectoryLock::~DirectoryLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void DirectoryLock::expect_free(const fs::path& directory) {
  const DirectoryLock for_a_moment(directory);
}

std::optional<fs::path> keep_older_results(const fs::path& directory) {
  if (!holds_results(directory)) return std::nullopt;
  DirectoryLock::expect_free(directory);
  const fs::path bare = directory.has_filename() ? directory : directory.parent_path();
  std::error_code error;
  if (bare.filename() == "." || bare.filename() == "..")
    throw OutputError("\"" + directory.string() +
                      "\" holds older results and cannot be renamed: name another directory");
  const fs::path kept = with_number(bare.string(), "");
  fs::rename(bare, kept, error);
  if (error)
    throw OutputError("cannot rename older results \"" + bare.string() + "\": " + error.message() +
                      "; name another directory");
  return kept;
}

std::optional<fs::path> keep_older_file(const fs::path& file, std::string_view text) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  std::ostringstream older;
  older << std::ifstream(file, std::ios::binary).rdbuf();
  if (older.view() == text) return std::nullopt;
  const fs::path kept = with_number((file.parent_path() / file.stem()).string(), file.extension().string());
  fs::rename(file, kept, error);
  if (error)
    throw OutputError("cannot rename the older \"" + file.string() + "\": " + error.message() +
                      "; name another file");
  return kept;
}

}  // namespace ddacontact
