/// \file What becomes of older results when a scene is run again, and of an edited file when it is made
/// again.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace ddacontact {

/// Renames a directory that holds results of a run to DIRECTORY.1, or the first number that is free, and
/// returns the new name; nothing where there are no results. Throws OutputError when it cannot be renamed.
std::optional<std::filesystem::path> keep_older_results(const std::filesystem::path& directory);

/// Renames a file that holds another text, rock.toml to rock.1.toml or the first number that is free, and
/// returns the new name; nothing where there is no such file. Throws OutputError when it cannot be renamed.
std::optional<std::filesystem::path> keep_older_file(const std::filesystem::path& file,
                                                     std::string_view text);

}  // namespace ddacontact
