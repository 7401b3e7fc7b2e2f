/// \file What the cases of a sweep came to.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// A number of a result: a dotted path into summary.json, or safety.json, or "monitor.NAME.COLUMN" at the
/// end.
struct Outcome {
  std::string name, path;
};

/// NAME=PATH. Throws Error for anything else.
Outcome parse_outcome(const std::string& text);

/// A row of sweep.csv.
struct CaseResult {
  std::string status;  ///< as in summary.json; "failed" without one
  std::string reason;
  /// None where the case failed.
  std::optional<double> steps_completed, time, max_displacement, kinetic, wall_seconds;
  std::vector<std::string> outcomes;  ///< as text; empty where the result has no such number
};

/// factor_low and factor_high, of searches for the factor of safety.
std::vector<Outcome> outcomes_of_safety();

/// The result in a directory, of a run or of a search for the factor of safety (steps and time are then those
/// of all trials, displacement and kinetic energy those of the one that moved at the lowest factor); without
/// a summary, `log` is the file whose first line is the reason.
CaseResult read_case(const std::filesystem::path& directory, const std::vector<Outcome>& outcomes,
                     const std::filesystem::path& log);

/// Whether a result has what an outcome asks for, be it none or an empty text.
bool has_outcome(const std::filesystem::path& directory, const Outcome& outcome);

/// Of the summary in a directory, or of its safety.json; empty without either.
std::string case_status(const std::filesystem::path& directory);

/// The finite number that a cell of sweep.csv is, one with a unit in SI; angles in degrees.
std::optional<double> number_of(const std::string& text);

/// Two columns of a table as curves, SVG: one for each combination of the other settings, dots alone where
/// these are many. Rows of failed cases and without both numbers are left out. Throws Error when a column is
/// not there or no row has both.
std::string curve_of(const std::filesystem::path& table, const std::string& x, const std::string& y);

}  // namespace ddacontact
