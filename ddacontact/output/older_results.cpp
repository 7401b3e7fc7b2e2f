#include <ddacontact/output/older_results.hpp>

#include <ddacontact/output/output_error.hpp>

#include <algorithm>
#include <array>
#include <string>

namespace ddacontact {

namespace fs = std::filesystem;

namespace {

bool holds_results(const fs::path& directory) {
  const std::array<const char*, 3> files{"summary.json", "energy.csv", "checkpoint.bin"};
  std::error_code missing;
  return std::ranges::any_of(files, [&](const char* file) { return fs::exists(directory / file, missing); });
}

}  // namespace

std::optional<fs::path> keep_older_results(const fs::path& directory) {
  if (!holds_results(directory)) return std::nullopt;
  const fs::path bare = directory.has_filename() ? directory : directory.parent_path();
  std::error_code error;
  if (bare.filename() == "." || bare.filename() == "..")
    throw OutputError("\"" + directory.string() +
                      "\" holds older results and cannot be renamed: name another directory");
  fs::path kept;
  for (int number = 1; kept.empty() || fs::exists(fs::symlink_status(kept, error)); ++number)
    kept = bare.string() + '.' + std::to_string(number);
  fs::rename(bare, kept, error);
  if (error)
    throw OutputError("cannot rename older results \"" + bare.string() + "\": " + error.message() +
                      "; name another directory");
  return kept;
}

}  // namespace ddacontact
