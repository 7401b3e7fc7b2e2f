/// \file What the program tells on stderr.
#pragma once

#include <fmt/format.h>
#include <ddacontact/scene/reader.hpp>

#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace dda {

/// Writes to stderr. Where that cannot be written the text is lost and nothing else: results count more.
template <class... T>
void say(fmt::format_string<T...> format, T&&... values) {
  std::fputs(fmt::format(format, std::forward<T>(values)...).c_str(), stderr);
}

/// `dda: error: TEXT`
void print_error(const std::string& text);

/// Says on stdout where an older file is now, if it was kept.
void tell_of_older(const std::string& file, const std::optional<std::filesystem::path>& kept);

/// Prints every problem of a reading, a line each, and returns the exit status it means.
int report(const ddacontact::SceneReading& reading);

}  // namespace dda
