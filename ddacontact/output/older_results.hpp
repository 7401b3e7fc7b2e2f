/// \file What becomes of older results when a scene is run again.
#pragma once

#include <filesystem>
#include <optional>

namespace ddacontact {

/// Renames a directory that holds results of a run to DIRECTORY.1, or the first number that is free, and
/// returns the new name; nothing where there are no results. Throws OutputError when it cannot be renamed.
std::optional<std::filesystem::path> keep_older_results(const std::filesystem::path& directory);

}  // namespace ddacontact
