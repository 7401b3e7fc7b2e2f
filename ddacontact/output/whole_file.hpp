/// \file Files that are written whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <ostream>
#include <string_view>

namespace ddacontact {

/// Writes a file under another name beside its own until it is complete: where that fails, an older one stays
/// as it was. Through a symbolic link its target is written; a device or a pipe, which must not be replaced,
/// under its own name. Throws OutputError that says why it cannot.
void write_whole(const std::filesystem::path& path, const std::function<void(std::ostream&)>& write_to);

/// The same, and an older file with another text gets the first number that is free, rock.1.toml, which is
/// returned.
std::optional<std::filesystem::path> write_and_keep_older(const std::filesystem::path& path,
                                                          std::string_view text);

}  // namespace ddacontact
