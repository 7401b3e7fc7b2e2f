/// \file The cases of a sweep: settings of a scene in all combinations, or row by row of a table.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// A path of the scene and the values that it takes one after the other.
struct Variation {
  std::string path;
  std::vector<std::string> values;
};

/// PATH=VALUES with VALUES "a,b,c", "from:to:count" (both ends), "1..100" (whole numbers, both ends), or
/// these between commas. Throws Error that says what is wrong.
Variation parse_variation(std::string_view text);

/// A sweep has at most so many cases.
inline constexpr std::size_t most_cases = 1'000'000;

/// Columns of settings; a row is a case.
struct SweepCases {
  std::vector<std::string> paths;
  std::vector<std::vector<std::string>> rows;  ///< values, as many as paths

  /// PATH=VALUE of a row.
  std::vector<std::string> settings(std::size_t row) const;
};

/// All combinations of the variations, the last one changing fastest, with each row of the table, whose
/// header names paths (no table: an empty path). Throws Error: nothing varies, a path stands twice, a
/// table has no rows, too many cases.
SweepCases sweep_cases(const std::vector<Variation>& variations, const std::filesystem::path& table);

}  // namespace ddacontact
