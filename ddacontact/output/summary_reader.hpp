/// \file summary.json of a result, read back.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

namespace ddacontact {

/// The numbers and texts of summary.json by their key; within an object or an array by both:
/// "energy.kinetic", "warnings.0". True and false are 1 and 0; what is none of these is left out.
struct SummaryTable {
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> texts;
  std::set<std::string> keys;  ///< all, those of what is left out too

  std::optional<double> number(const std::string& key) const;
  /// Empty when there is none.
  std::string text(const std::string& key) const;
};

/// Throws Error, which names the file, when it cannot be read or is no JSON object.
SummaryTable read_summary(const std::filesystem::path& path);

}  // namespace ddacontact
